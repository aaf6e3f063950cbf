"""What ``asperity new`` does."""

import dataclasses
import sys
from collections.abc import Collection, Iterable, Mapping, Sequence, Set
from pathlib import Path

from asperity.casefile.case import Case
from asperity.casefile.setting import apply
from asperity.cli import show
from asperity.commands import case_tables
from asperity.errors import InputError, plain
from asperity.files.store import write_text
from asperity.rating.load_steps import LOADS
from asperity.rating.parameters import Operation
from asperity.runs.asking import typed_line
from asperity.start.data_file import DATA_FILES
from asperity.start.duty import complete, sized
from asperity.start.gear import MACRO, drop_begun_life, operation_of, proposals, ratio_of
from asperity.start.kinds import RATIO, Kind, Question, Values, kind_of
from asperity.start.write import case_text


def new(
    name: str,
    file: Path | None,
    operation_options: Mapping[str, str | None],
    settings: Sequence[str],
    ratio: str,
    read: str = "",
    *,
    defaults: bool,
    as_json: bool,
) -> None:
    """Write a case file of a kind, asking what is not given where there is somebody to ask.

    What is asked is by key of the operation, None where it is not; a file without an ending gets
    one. What is read is the name of a REXS file, which says all that is not asked or set.
    """
    path = file or Path(name)
    path = path if path.suffix else path.with_name(f"{path.name}.toml")
    if name in DATA_FILES:
        if read:
            raise InputError(f"--from {plain(read)}: a REXS file is read as a gear, not as {name}")
        _new_data(name, path, operation_options, settings, ratio, as_json=as_json)
        return
    kind = kind_of(name)
    if (
        any(each is not None for each in operation_options.values())
        and Operation.table not in kind.tables
    ):
        raise InputError(f"--output-torque and --worm-speed are of a gear; {name} has neither")
    if path.exists():
        raise InputError(f"{plain(str(path))} is there already; name another file")
    values, told = kind.begun(), tuple[str, ...]()
    if read:
        values, told = _received(name, read, values, ratio)
    given = given_to(values, operation_options, settings)
    if ratio and "requirements" in kind.values:
        given |= {apply(values, f"requirements.ratio={ratio_of(ratio):g}", case_tables())}
    wanted = ratio or values.get("requirements", {}).get("ratio") or RATIO
    asks = (
        not defaults and not read and sys.stdin is not None and sys.stdin.isatty() and not as_json
    )
    if asks:
        for question in kind.questions:
            if question.path == "ratio":
                if "requirements.ratio" not in given:
                    wanted = ratio or _asked_ratio(question)
            elif question.path not in given and question.counts(values):
                _follow(kind, values, given, question.path)
                _ask(question, values)
    _follow(kind, values, given)
    remarks = [
        "Every key that stands behind a # may be given as well; what it says is assumed, or an "
        "example where its line says so."
    ]
    remarks += told
    if kind.case:
        remarks.append(
            f"What is given is that of {kind.case}; asperity cases {kind.case} prints it with "
            "where each value comes from. Replace it by your own."
        )
    if "gearset" in values and not read and name != "duty":
        remarks += _sized(values, given, ratio_of(wanted))
    assumed = _assumed(kind, values, given)
    case = Case(path.name, path.parent.absolute(), {}, values, case_tables())
    if name == "duty":
        # What size refuses is not written; what a duty says of a gearset is a part of one.
        sized(case)
        case = dataclasses.replace(case, raw={k: v for k, v in values.items() if k != "gearset"})
    case = case.replace(())
    title = f"{kind.title}, begun by asperity new"
    names = (*kind.tables, *(table for table in values if table not in kind.tables))
    of_keys = {path: f"Assumed: {mend}." for path, mend in assumed.items()}
    text = case_text(title, values, case_tables(), names, remarks, of_keys)
    write_text(path, text)
    for remark in told[1:]:
        show.note(remark)
    if as_json:
        show.print_json({"file": str(path), "tables": list(case.tables), "assumed": list(assumed)})
    else:
        show.print_text(_what_next(path, kind))
        operation = case.get(Operation)
        if operation and operation.wear_assumed:
            show.print_text(f"\n{operation.wear_assumed}")
        if assumed:
            lines = [f"  {key} = {_value(values, key)}: {assumed[key]}" for key in assumed]
            if not asks and (examples := _examples(kind, values, given)):
                lines.append(f"  and examples, as nothing was asked: {', '.join(examples)}")
            show.print_text("\n".join(["\nassumed, replace it by your own:", *lines]))


def _assumed(kind: Kind, values: Values, keys: Collection[str]) -> dict[str, str]:
    """Return what to do about each key that is assumed; leaves out those that others stand for."""
    assumed = {}
    for path, (mend, instead) in kind.assumed.items():
        table, _, key = path.partition(".")
        if path in keys or key not in values.get(table, {}):
            continue
        if instead and set(instead) <= set(keys):
            values[table].pop(key)
        else:
            assumed[path] = mend
    return assumed


def _examples(kind: Kind, values: Values, keys: Collection[str]) -> list[str]:
    """Return the keys that a question would fill and nobody gave."""
    found = []
    for question in kind.questions:
        table, _, key = question.path.partition(".")
        if question.path not in keys and key in values.get(table, {}):
            found.append(question.path)
    return found


def _value(values: Values, path: str) -> object:
    table, _, key = path.partition(".")
    return values[table][key]


def _follow(kind: Kind, values: Values, keys: Collection[str], only: str = "") -> None:
    """Let what is still empty follow from what others are by now."""
    for path, text in kind.follows.items():
        table, _, key = path.partition(".")
        if path in (only or path,) and path not in keys and not values[table].get(key):
            values[table][key] = text.format_map(values)


def _received(name: str, file: str, begun: Values, ratio: str) -> tuple[Values, tuple[str, ...]]:
    """Return the tables of a REXS file and what is to be said of them; raises InputError."""
    from asperity.flanks.export.rexs.read import read_rexs

    if name != "gear":
        raise InputError(f"--from {plain(file)}: a REXS file is read as a gear, not as {name}")
    if ratio:
        raise InputError(f"--ratio {ratio}: --from {plain(file)} says the ratio; keep one of them")
    found = read_rexs(Path(file))
    tables = found.tables
    operation = tables.setdefault("operation", {})
    missing = [key for key in ("worm_speed", "output_torque", "lubricant") if key not in operation]
    for key in missing:
        operation[key] = begun["operation"][key]
    said = [f"It was read from {plain(Path(file).name)}.", *found.remarks]
    if missing:
        said.append(f"assumed, replace it by your own: operation.{', operation.'.join(missing)}")
    return tables, tuple(said)


def _new_data(
    name: str,
    path: Path,
    operation_options: Mapping[str, str | None],
    settings: Sequence[str],
    ratio: str,
    *,
    as_json: bool,
) -> None:
    """Write a data file of bearings or plastics, which has nothing that can be asked."""
    data = DATA_FILES[name]
    if settings or ratio or any(each is not None for each in operation_options.values()):
        raise InputError(
            "--set, --ratio, --output-torque and --worm-speed are of a case; a data file of "
            f"{name}s has none: leave them out"
        )
    if path.exists():
        raise InputError(f"{plain(str(path))} is there already; name another file")
    write_text(path, data.text(name))
    if as_json:
        show.print_json({"file": str(path), "tables": [name]})
    else:
        file = plain(str(path))
        show.print_text(
            f"{file} is written; go on with\n\n  asperity --materials {file} {data.listed}"
        )


OTHER_FORMS = ("worm_pitch_diameter", "profile_shift")
"""Of what a proposal says."""

_FORMS = {
    "output_torque": LOADS,
    "input_power": LOADS,
    "worm_speed": ("worm_speed",),
}
"""What of the operation has an option, and what would take its place."""


def given_to(
    values: Values, operation_options: Mapping[str, str | None], settings: Sequence[str]
) -> Set[str]:
    """Apply what is asked of the operation, and settings; returns their keys."""
    keys = set()
    loads = [
        f"--{key.replace('_', '-')} {operation_options[key]}"
        for key in LOADS
        if operation_options.get(key)
    ]
    if len(loads) > 1:
        raise InputError(f"{loads[1]}: {loads[0]} says what it comes to; keep one of them")
    for setting in settings:
        table, _, name = setting.partition("=")[0].strip().partition(".")
        for key, forms in _FORMS.items():
            if table == "operation" and name in forms and operation_options.get(key) is not None:
                raise InputError(
                    f"--set {setting}: --{key.replace('_', '-')} {operation_options[key]} says the "
                    "same; keep one of them"
                )
    for key, text in operation_options.items():
        if text is not None:
            setting, option = f"operation.{key}={text}", f"--{key.replace('_', '-')} {text}"
            try:
                keys.add(apply(values, setting, case_tables()))
            except InputError as error:
                raise InputError(str(error).replace(f"--set {setting}", option)) from None
    keys |= {apply(values, setting, case_tables()) for setting in settings}
    drop_begun_life(values, keys)
    return keys


def _sized(values: Values, keys: Iterable[str], ratio: float) -> list[str]:
    """Fill in the macro-geometry that is not given; returns what is to be said of it."""
    macro = [key for key in MACRO if f"gearset.{key}" in keys]
    if len(macro) >= len(MACRO) - 1:
        return []
    found = proposals(values, ratio, exact=True)
    best = found.found[0]
    # Behind the name, before the materials.
    gearset = values["gearset"]
    kept = {key: value for key, value in gearset.items() if key not in (*MACRO, *OTHER_FORMS)}
    values["gearset"] = {"name": kept.pop("name", ""), **best.keys, **kept}
    judged = (
        "the smallest that holds by every standard"
        if found.holding
        else "the smallest that holds by the standards that can rate it"
        if best.holds
        else "which does not hold by every standard, but comes nearest"
    )
    return [
        f"Starts, teeth, centre distance, module and diameter factor are proposed for a ratio of "
        f"{ratio:g}: of {found.rated} gearsets {judged}. See asperity size for others."
    ]


def _what_next(path: Path, kind: Kind) -> str:
    first, *others = kind.then
    name = plain(str(path))
    more = f" (or {', '.join(others)})" if others else ""
    return f"{name} is written; go on with\n\n  asperity {first} {name}{more}"


def _ask(question: Question, values: Values) -> None:
    table, _, key = question.path.partition(".")
    while True:
        before = dict(values.get(table, {}))
        now = before.get(key, "left out" if question.optional else None)
        answer = _answer(f"{question.words} [{now}]: ")
        if not answer:
            return
        try:
            apply(values, f"{question.path}={answer}", case_tables())
            _try(question.path, values)
        except InputError as error:
            values[table] = before
            if not before:
                values.pop(table)
            show.note(str(error).removeprefix(f"--set {question.path}={answer}: "))
        else:
            return


def _try(path: str, values: Values) -> None:
    from asperity.casefile.check import mistakes_of

    table = path.partition(".")[0]
    for key, sentence in mistakes_of(case_tables()[table], values[table]):
        if key == path:
            raise InputError(sentence)
    if path == "spectrum.step":
        # Loads are of a life under a rated torque, which is known by now.
        run = {name: dict(values[name]) for name in ("operation", "spectrum")}
        complete(run)
        operation_of(run)


def _asked_ratio(question: Question) -> str:
    while True:
        answer = _answer(f"{question.words} [{RATIO}]: ") or RATIO
        try:
            ratio_of(answer)
        except InputError as error:
            show.note(str(error))
        else:
            return answer


def _answer(prompt: str) -> str:
    if (line := typed_line(prompt)) is None:
        raise KeyboardInterrupt("interrupted; nothing is written")
    return line
