"""No key of a case file takes a number that is too large to calculate with, either way.

Keys, their kinds and units are those of the schema, of tables within tables too; what a key reads
by itself is given the number in the forms that such keys have.
"""

import functools
from typing import get_args

import pytest

from asperity.casefile import Table
from asperity.casefile.check import mistakes_of
from asperity.casefile.schema import keys_of
from asperity.commands import case_tables

LARGE = (1e300, -1e300, 10**31, -(10**31))
UNITS = "", "m", "mm", "deg", "N", "N m", "Hz", "s", "K", "rpm", "V", "per turn"
SEEDS = {"plan", "twin"}  # have more digits, and nothing is calculated with them
DIGITS = 1 << 128
# What is refused for something beside it, which the table has not.
BESIDE = {
    "contact.initial_stiffness", "housing.measured_at", "reduction.least_window",
    "wear.coefficient", "wear.conductivity", "wear.diffusivity", "wear.hardness",
}  # fmt: skip


def within(annotation):
    """Yield the tables that an annotation holds."""
    if isinstance(annotation, type) and issubclass(annotation, Table):
        yield annotation
    for part in get_args(annotation):
        yield from within(part)


@functools.cache
def models():
    """Every table of a case file, and those within them, by name."""
    found, left = {}, list(case_tables().values())
    while left:
        model = left.pop()
        if found.setdefault(f"{model.table or model.__name__}", model) is model:
            for field in model.model_fields.values():
                left += [inner for inner in within(field.annotation) if inner not in
                         found.values()]  # fmt: skip
    return found


def example(schema):
    """A value that is right."""
    if "anyOf" in schema:
        return example(schema["anyOf"][0])
    for word in ("const", "enum", "examples"):
        if schema.get(word):
            return schema[word] if word == "const" else schema[word][0]
    kind = schema.get("type")
    if kind == "array":
        first = [example(part) for part in schema.get("prefixItems", ())]
        return first or [example(schema.get("items") or {})] * schema.get("minItems", 1)
    if kind == "object":
        return {key: example(schema["properties"][key]) for key in schema.get("required", ())}
    return {"integer": schema.get("minimum", 1), "number": 1.0, "boolean": True}.get(kind, "x")


def small(schema):
    """Yield values of a quantity, of which one is right."""
    yield example(schema)
    if "number" in (part.get("type") for part in schema.get("anyOf", [schema])):
        yield from (0.1, 0.6, 5.0)


def large(schema, number):
    """Yield values of a key that hold a number, wherever it may stand but in a table."""
    for part in schema.get("anyOf", ()):
        yield from large(part, number)
    kind, quantity = schema.get("type"), schema.get("quantity")
    if quantity is not None:
        yield f"{number!r} {quantity['unit']}".strip()
        if not quantity["unit"]:
            yield number
    elif kind == "number":
        yield number
    elif kind == "integer":
        yield int(number)
    elif kind == "array":
        first = schema.get("prefixItems", [])
        for place, part in enumerate(first):
            for value in large(part, number):
                yield [value if n == place else example(p) for n, p in enumerate(first)]
        if schema.get("items"):
            for value in large(schema["items"], number):
                yield [value] * schema.get("minItems", 1)
    elif kind == "object" and isinstance(schema.get("additionalProperties"), dict):
        names = schema.get("propertyNames", {}).get("enum", ["x"])
        for value in large(schema["additionalProperties"], number):
            yield {names[0]: value}
    elif not schema.keys() - {"description", "default"}:
        texts = [f"{number!r} {unit}".strip() for unit in UNITS]
        yield from (*texts, *([text] for text in texts), number, [number])


def takes(model, key, value):
    """Whether a table takes a value of a key: nothing is said of it but what it lacks besides."""
    said = [
        sentence
        for path, sentence in mistakes_of(model, {key: value})
        if path.endswith(f".{key}") or f".{key} " in sentence
    ]
    return not any("missing" not in sentence for sentence in said)


def given(model):
    """Yield the keys of a table with values that hold such a number."""
    for key in keys_of(model):
        larger = key.name == "seed" and model.table in SEEDS
        for number in LARGE[:2] if larger else LARGE:
            for value in large(key.schema, number):
                yield key.name, value


def test_most_keys_are_tried_and_all_that_are_a_quantity():
    for model in models().values():
        tried = {key for key, _ in given(model)}
        for key in keys_of(model):
            if "quantity" in str(key.schema) or key.schema.get("type") in ("number", "integer"):
                assert key.name in tried or "properties" in str(key.schema), (model, key.name)


@pytest.mark.ordinary(23)
@pytest.mark.parametrize("name", list(models()))
def test_no_key_takes_a_number_of_three_hundred_digits(name):
    model = models()[name]
    taken = [(key, value) for key, value in given(model) if takes(model, key, value)]
    assert not taken


def test_a_number_that_is_right_is_taken():
    for name, key, value in (
        ("slider", "normal_force", "55 N"), ("vibration", "direction", "-720 deg"),
        ("gearset", "starts", 2), ("plan", "seed", DIGITS - 1), ("hob", "tip_radius", "0.5 mm"),
    ):  # fmt: skip
        assert takes(models()[name], key, value), key
    assert not takes(models()["plan"], "seed", DIGITS)
    assert not takes(models()["twin"], "seed", DIGITS)


def test_what_the_schema_gives_as_an_example_is_taken():
    """What refuses a large number is not another mistake that a small one would be told too."""
    refused, tried = set(), 0
    for name, model in models().items():
        for key in keys_of(model):
            if any(part.get("quantity") for part in key.schema.get("anyOf", [key.schema])):
                tried += 1
                if not any(takes(model, key.name, value) for value in small(key.schema)):
                    refused.add(f"{name}.{key.name}")
    assert refused == BESIDE
    assert tried > 250
