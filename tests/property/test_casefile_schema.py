"""``asperity check`` and ``asperity schema`` agree on every table with its keys changed at random.

How several keys go together is more than a schema can say; those mistakes are left out of the
comparison, and only those.
"""

import functools
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from asperity.casefile.check import mistakes_of
from asperity.casefile.schema import table_schema
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.files.shipped import shipped_cases
from asperity.files.store import read_toml
from asperity.tribometer.tables import TABLES as RIG
from asperity.units import Quantity

# Below the keys of the rig's tables stand tables with readers of their own.
TABLES = {name: model for name, model in case_tables().items() if name not in RIG}
SHIPPED = [
    (name, entries)
    for path in shipped_cases().values()
    for name, entries in read_toml(path).items()
    if name in TABLES
]
ODD = st.one_of(
    st.none().map(lambda _: True),
    st.integers(-3, 10**4),
    st.floats(-1e3, 1e3).filter(lambda number: number != int(number)),
    st.sampled_from(
        ["", "x", "1", "3 mm", "-3 mm", "20 deg", "1 kg", "2 GPa", "5 %", "auto", "ZI"]
    ),
    st.just([]),
    st.just(["1 mm", "2 mm"]),
    st.just([1, 2, 3]),
    st.just({}),
    st.just({"a": 1}),
)
SAID = {"description", "default"}
KINDS = {
    "string": str, "number": int | float, "integer": int, "boolean": bool, "array": list,
    "object": dict,
}  # fmt: skip


@functools.cache
def schema_of(name):
    return table_schema(TABLES[name])


def is_kind(value, kind):
    if kind == "integer" and isinstance(value, float):
        return value == int(value)
    return isinstance(value, KINDS[kind]) and (kind == "boolean" or not isinstance(value, bool))


def holds(schema, value):
    """Whether a value keeps a schema, of the keywords that are used, with ``quantity``."""
    within = {
        "type": lambda kind: is_kind(value, kind),
        "enum": lambda words: any(type(w) is type(value) and w == value for w in words),
        "const": lambda word: value == word,
        "minimum": lambda limit: value >= limit,
        "maximum": lambda limit: value <= limit,
        "exclusiveMinimum": lambda limit: value > limit,
        "exclusiveMaximum": lambda limit: value < limit,
        "pattern": lambda pattern: bool(re.search(pattern, value)),
        "quantity": lambda said: is_quantity(said, value),
        "anyOf": lambda parts: any(holds(part, value) for part in parts),
        "allOf": lambda parts: all(holds(part, value) for part in parts),
        "not": lambda part: not holds(part, value),
        "required": lambda keys: all(key in value for key in keys),
        "minItems": lambda count: len(value) >= count,
        "properties": lambda keys: all(
            holds(part, value[key]) for key, part in keys.items() if key in value
        ),
        "propertyNames": lambda part: all(holds(part, key) for key in value),
    }
    for keyword, said in schema.items():
        if keyword in within and not within[keyword](said):
            return False
    if isinstance(value, dict) and "additionalProperties" in schema:
        others = {k: v for k, v in value.items() if k not in schema.get("properties", {})}
        part = schema["additionalProperties"]
        if others and (part is False or not all(holds(part, v) for v in others.values())):
            return False
    if isinstance(value, list):
        first = schema.get("prefixItems", [])
        rest = schema.get("items", {})
        if not all(holds(part, v) for part, v in zip(first, value, strict=False)):
            return False
        more = value[len(first) :]
        return not more if rest is False else all(holds(rest, v) for v in more)
    return True


def is_quantity(said, value):
    limits = {name: said[name] for name in ("gt", "ge", "lt", "le") if name in said}
    example = f"1 {said['unit']}" if said["unit"] else "1"
    try:
        Quantity(said["unit"], "a quantity", example, **limits).check(value, text_only=True)
    except InputError:
        return False
    return True


def of_one_key(model, entries, mistake):
    """Whether a mistake is one of a key, of one that lacks, or of two forms of a thing."""
    path, sentence = mistake
    key = path.partition(".")[2].partition(".")[0]
    if key not in entries:
        return sentence in [*model.forms(entries)] or model.model_fields[key].is_required()
    if key not in model.model_fields or sentence in [*model.forms(entries)]:
        return True
    others = (f"{model.table}.{other} " for other in model.model_fields if other != key)
    if any(other in sentence for other in others):
        return False
    return any(said == sentence for _, said in mistakes_of(model, {key: entries[key]}))


@st.composite
def tables(draw):
    name, entries = draw(st.sampled_from(SHIPPED))
    model, changed = TABLES[name], dict(entries)
    for _ in range(draw(st.integers(0, 3))):
        key = draw(st.sampled_from([*model.model_fields, "nonesuch"]))
        if draw(st.booleans()) and draw(st.booleans()):
            changed.pop(key, None)
        else:
            changed[key] = draw(ODD)
    return name, changed


@pytest.mark.slow
@given(tables())
def test_what_one_accepts_the_other_does(case):
    name, entries = case
    model = TABLES[name]
    wrong = [m for m in mistakes_of(model, entries) if of_one_key(model, entries, m)]
    named = [key for key in ("worm_material", "wheel_material", "lubricant", "bearings", "motor")
             if isinstance(entries.get(key), str)]  # fmt: skip
    # Which names there are is a matter of data files, which may be the user's own.
    # A key with a reader of its own may have any value as far as the schema goes.
    named += [k for k, part in schema_of(name)["properties"].items() if not part.keys() - SAID]
    wrong = [m for m in wrong if m[0].partition(".")[2].partition(".")[0] not in named]
    assert (not wrong) == holds(schema_of(name), entries), wrong


def test_the_reader_of_schemas_of_this_test_can_say_no():
    gearset = schema_of("gearset")
    good = dict(next(entries for name, entries in SHIPPED if name == "gearset"))
    assert holds(gearset, good)
    for wrong in (
        {"starts": 0}, {"starts": True}, {"flank": "ZX"}, {"centre_distance": "3 kg"},
        {"centre_distance": 75}, {"pressure_angle": "50 deg"}, {"nonesuch": 1},
        {"worm_pitch_diameter": "18 mm"}, {"wheel_material": {"family": "gold"}},
    ):  # fmt: skip
        assert not holds(gearset, good | wrong), wrong
    assert not holds(gearset, {"starts": 1})
