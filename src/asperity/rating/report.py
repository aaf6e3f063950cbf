"""What the report of a rating says, from verdict to sources."""

import dataclasses
from collections.abc import Iterator
from typing import Any

from asperity.gearset.answer import Views, drawn, views_of
from asperity.rating.duty import duty_table
from asperity.rating.endurance import endurance_table
from asperity.rating.forces import MEANINGS
from asperity.rating.holding import held_table
from asperity.rating.power_flow import power_flow
from asperity.rating.power_words import load_drives
from asperity.rating.result import Rating
from asperity.rating.standing import NAMES
from asperity.rating.starting import starting_table
from asperity.rating.verdict import bar, locking_line
from asperity.rating.verdict_rows import beside
from asperity.results.report import Picture, Section
from asperity.results.table import Bar, Column, Table
from asperity.results.words import Number, Sentence, text_of
from asperity.sources import Source

_NAMED = ("symbol", "value", "unit", "meaning", "equation", "source")
_FRAME = (
    "Under the rated torque, the worm driving, by ISO/TR 14521. x points along the worm to the end "
    "it is driven at, y from the wheel's axis to the worm's, z completes a right-handed system; "
    "the rotation is the worm's, seen from the end it is driven at. Each bearing of the worm "
    "carries what is across it, the fixed one its axial force too. The wheel's bearings are not "
    "part of a case: its shaft takes the wheel's forces at the reference circle."
)

_WORM_DRIVES = (
    "Here the worm drives. In this duty the load does: what it puts in and loses stands in the "
    "verdict."
)

_NO_CONTACT = (
    "The standards need none, so that no flanks were cut: asperity rate CASE --out FOLDER "
    "--pattern shows them here, and asperity flank CASE --out FOLDER tells all of the flanks."
)


Reported = Any
"""A `asperity.rating.rated.Rated`, whose module imports this one."""


def both_views(rated: Reported) -> Views:
    """Return both views of a gearset that is rated, with its shafts where there are any."""
    if rated.shafts is None:
        return views_of(rated.geometry, rated.gearset.hand)
    views: Views = rated.shafts.both_views()
    return views


def sections(rated: Reported) -> Iterator[Section]:
    """Yield the sections of the report of a rating."""
    cited: dict[Source, int] = {}
    verdict = (*_verdict(rated), *beside(rated.rows))
    yield Section("Verdict", tuple(_come_to(rated)), tables=verdict)
    yield dataclasses.replace(drawn(both_views(rated)), tables=(_geometry(rated),))
    if rated.iso14521 is not None:
        caption = "The worm driving, by ISO/TR 14521; bands as wide as the power."
        flow = Picture("", svg=power_flow(rated.iso14521), caption=caption)
        drives = (_WORM_DRIVES,) if load_drives(rated.rating_inputs) else ()
        yield Section("Power", drives, pictures=(flow,), tables=(_power(rated.iso14521),))
        if rated.duty_cycle:
            yield _duty(rated)
        elif rated.rating_inputs.operation.housing is not None:
            yield Section("Heat", tuple(rated.of_duty))
        said = f"The worm's hand is {rated.gearset.hand}. {_FRAME}"
        by = "Forces on shafts and bearings, by ISO/TR 14521"
        yield Section(by, (said, *_of_agma(rated)), tables=(_forces(rated),))
    yield rated.contact or Section("Contact pattern and lines", (_NO_CONTACT,))
    yield Section("Self-locking", tables=(rated.self_locking.table(), *_held(rated)))
    if rated.backlash is not None:
        yield Section("Backlash", tables=(rated.backlash.table(),))
    limits = tuple(
        Table((), (), title, rating.violations or ("no limit of validity is violated",))
        for title, rating in ((rating.standard, rating) for rating in rated.ratings)
    )
    texts = tuple(line for t in limits for line in (f"{t.title}: {'; '.join(t.remarks)}.",))
    notes = Table((), (), remarks=(*rated.notes, *(n for r in rated.ratings for n in r.notes)))
    yield Section("Limits and notes", texts, tables=(notes,))
    yield Section("Assumed", tables=(_assumed(rated),))
    yield Section("From memory: check before use", tables=(_from_memory(rated),))
    for name, rating in rated.found.items():
        yield Section(f"Calculation by {rating.standard}", tables=(_numbers(name, rating, cited),))
    yield Section("Sources", tables=(_sources(cited),))


def _duty(rated: Reported) -> Section:
    """Return what each load has in wear and heat, and how warm the housing gets."""
    iso, inputs = rated.iso14521, rated.rating_inputs
    tables = [duty_table(rated.duty_cycle)]
    from asperity.rating.duty_plots import plot_duty
    from asperity.rating.warming import warming

    if rated.endurance:
        tables.append(endurance_table(rated.endurance))
    tables += [starting_table(rated.starting)] if rated.starting else []
    figure = plot_duty(rated.duty_cycle, float(iso["theta_S_lim_degC"]), warming(inputs, iso))
    caption = (
        "Losses over the running time of the loads, and the oil's temperature: by the heat balance "
        "under the greatest loss where the housing's heat capacity is known, else by ISO/TR 14521."
    )
    picture = Picture("", figure=figure, caption=caption)
    return Section("Loads and heat", rated.of_duty, pictures=(picture,), tables=tuple(tables))


def _of_agma(rated: Reported) -> Iterator[str]:
    """Say where AGMA 6034 has another force, since it has friction of its own."""
    iso, agma = rated.iso14521, rated.agma6034
    if agma is not None:
        there = Number.of(float(iso["F_tm1_N"]), ".5g", "iso14521.F_tm1_N")
        other = Number.of(float(agma["W_W_N"]), ".5g", "agma6034.W_W_N")
        yield Sentence(
            "The tangential force on the worm is F_tm1 = ", there, " N here; AGMA 6034, by its own "
            "friction and formula, has W_W = ", other, " N for it, which its calculation shows.",
        )  # fmt: skip


def _come_to(rated: Reported) -> Iterator[str]:
    """Yield the sentences of the verdict: strength, power, film, self-locking."""
    verdict = rated.verdict
    yield from verdict.sentences()
    yield from rated.of_power
    if verdict.film is not None:
        yield verdict.film.sentence("verdict.film")
    yield locking_line(rated.self_locking)
    if rated.backlash is not None:
        yield rated.backlash.sentence()


def _columns(*names: str) -> tuple[Column, ...]:
    return tuple(
        Column(name, right=name == "value", typeset=name in ("symbol", "equation", "unit"))
        for name in names
    )


def _verdict(rated: Reported) -> Iterator[Table]:
    rows = []
    for place, safety in enumerate(rated.verdict.safeties):
        d, key = safety.demand, f"verdict.safeties.{place}"
        rows.append(
            (
                f"{NAMES[d.standard]} {d.name}",
                d.symbol,
                text_of(safety.value, key=f"{key}.value"),
                text_of(d.asked, key=f"{key}.asked"),
                Bar(bar(safety.margin), safety.margin),
                "holds" if safety.holds else "FAILS",
            )
        )
    columns = (
        Column("safety"), Column("symbol", typeset=True), Column("value", right=True),
        Column("asked", right=True), Column(""), Column(""),
    )  # fmt: skip
    said = "Bars end at three times what is asked; the mark is what is asked."
    told = rated.rating_inputs.operation.wear_sentence(
        "iso14521" if rated.iso14521 is not None else ""
    )
    wear = (told,) if rated.verdict.wear_assumed else ()
    unrated = tuple(f"no answer: {path}" for path in rated.verdict.unrated)
    heat = (rated.verdict.heat_assumed,) if rated.verdict.heat_assumed else ()
    yield Table(columns, tuple(rows), remarks=(said, *wear, *heat, *unrated))


def _geometry(rated: Reported) -> Table:
    rows = []
    values = rated.geometry.to_json()
    for name, field in type(rated.geometry).__dataclass_fields__.items():
        known = field.metadata
        unit = {"rad": "deg"}.get(known["unit"], known["unit"])
        suffix = f"_{unit.replace('/', '_per_')}" if unit else ""
        key = f"{name}{suffix}"
        if values.get(key) is not None:
            number = text_of(values[key], key=f"geometry.{key}")
            rows.append((known["symbol"], number, unit, known["meaning"]))
    return Table(_columns("symbol", "value", "unit", "meaning"), tuple(rows))


def _power(iso: Rating) -> Table:
    keys = (
        "input_power_W", "loss_meshing_W", "loss_idle_W", "loss_bearing_W", "loss_seal_W",
        "loss_total_W", "output_power_W", "eta_z1_2", "eta_ges", "input_torque_Nm",
        "output_torque_Nm",
    )  # fmt: skip
    rows = []
    for entry in (iso.entry(key) for key in keys if key in iso):
        value = text_of(entry.value, key=f"iso14521.{entry.key}")
        rows.append((entry.symbol, value, entry.unit, entry.meaning))
    return Table(_columns("symbol", "value", "unit", "meaning"), tuple(rows))


def _forces(rated: Reported) -> Table:
    found = {one.rotation: one.to_json() for one in rated.forces}
    rows = tuple(
        (
            meaning,
            symbol,
            *(text_of(own[key], key=f"forces.{name}.{key}") for name, own in found.items()),
            "N",
            equation,
        )
        for key, (meaning, symbol, equation) in MEANINGS.items()
    )
    columns = (
        Column("force"), Column("symbol", typeset=True),
        *(Column(name, right=True) for name in found), Column("unit"),
        Column("equation", typeset=True),
    )  # fmt: skip
    return Table(columns, rows)


def _held(rated: Reported) -> tuple[Table, ...]:
    return (held_table(rated.holding),) if rated.holding else ()


def _assumed(rated: Reported) -> Table:
    return Table.of(("key", "what was assumed"), rated.assumed.items(), left=2)


def _from_memory(rated: Reported) -> Table:
    rows = [
        (NAMES[name], entry.symbol or entry.key, entry.meaning, str(entry.source.name))
        for name, rating in rated.found.items()
        for entry in rating
        if entry.from_memory
    ]
    table = Table.of(("standard", "symbol", "meaning", "source"), rows, left=4)
    columns = tuple(
        Column(column.heading, typeset=column.heading == "symbol") for column in table.columns
    )
    return Table(columns, table.rows)


def _numbers(name: str, rating: Rating, cited: dict[Source, int]) -> Table:
    rows = []
    for entry in rating:
        number = cited.setdefault(entry.source, len(cited) + 1)
        value = text_of(entry.value, key=f"{name}.{entry.key}")
        rows.append(
            (
                entry.symbol or entry.key,
                value,
                entry.unit,
                entry.meaning,
                entry.shown_equation,
                f"{entry.trust} [{number}]",
            )
        )
    return Table(_columns(*_NAMED), tuple(rows))


def _sources(cited: dict[Source, int]) -> Table:
    rows = [(f"[{n}]", s.name, s.confidence, s.note) for s, n in cited.items()]
    return Table.of(("", "source", "confidence", "note"), rows, left=4)
