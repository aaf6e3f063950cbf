"""What is answered, by the worker that solves and by the one that looks things up."""

import json
from pathlib import Path
from typing import Any

from asperity.casefile import Case, naming_source
from asperity.casefile.check import check_case
from asperity.casefile.named import named_files
from asperity.commands import case_tables
from asperity.commands.request import Body, CommandRequest, mapping, settings
from asperity.errors import InputError
from asperity.files.store import read_text
from asperity.results import Result
from asperity.results.dataset import variables
from asperity.results.payload import as_payload
from asperity.runs import Run
from asperity.start.write import as_set, as_written
from asperity.web.ask import case_of, confine, request_of
from asperity.web.folder import SO_FAR, Folder

_MOST_POINTS = 400
_SHIPPED = Path(__file__).with_name("static") / "shown"


def solved(folder: Folder, body: Body) -> dict[str, Any]:
    """Answer a command that takes milliseconds."""
    request = request_of({**body, "command": body["verb"]}, folder)
    case = case_of(request, folder)
    run = Run()
    # Its history is drawn.
    run.detailed = True
    with naming_source(case):
        result = request.command.solved(request.command.prepared(case, **request.options), run)
    return answer_of(request, case, result)


def answer_of(request: CommandRequest, case: Case, result: Result) -> dict[str, Any]:
    """Return everything that is told of a result, and how to get it again."""
    return {**as_payload(result), "command": request.line, "toml": as_set(case)}


def curve(folder: Folder, body: Body) -> dict[str, Any]:
    """Return the ratio of a body over the direction or the strength of its vibration."""
    from asperity.slider.curves import curve
    from asperity.slider.slide import prepare

    case = case_of(request_of({**body, "command": "slide", "options": {}}, folder), folder)
    options = mapping(body, "options")
    chosen = {name: options[name] for name in ("over", "points") if name in options}
    with naming_source(case):
        return {"answer": chosen, "series": curve(prepare(case), **chosen).to_json()}


def size(folder: Folder, body: Body) -> dict[str, Any]:
    """Propose gearsets for a ratio, a torque and a speed; as a page that prints if asked for."""
    from asperity import __version__
    from asperity.python import size
    from asperity.results.report import Heading
    from asperity.start.gear import SIZE, ratio_of

    # A page waits for milliseconds: no wheel is cut here.
    given = SIZE.given({}, {**mapping(body, "options"), "uncut": True})
    changes, ratio = settings(body), ratio_of(given["ratio"])
    for name in named_files(changes, case_tables()):
        folder.inside(name)
    of_it = {name: text for name, text in given.items() if name not in ("ratio", "uncut")}
    found = size(ratio, **of_it, settings=changes, cut=False)
    if body.get("report") is True:
        asked = {name: str(text) for name, text in given.items() if name != "uncut" and text}
        set_so = dict(change.split("=", 1) for change in changes)
        return {"html": found.to_html(Heading(given=asked | set_so, version=__version__))}
    answer = found.to_json()
    return {
        "answer": answer,
        "rows": answer["proposals"],
        "notes": list(found.notes),
        "command": SIZE.line("", changes, given),
    }


def check(folder: Folder, body: Body) -> dict[str, Any]:
    """Return all mistakes of a case; and the case with its settings as a file, if it is read."""
    from asperity.start.check import check

    request = request_of({**body, "command": "slide"}, folder)
    confine(check_case(folder.case_name(request.name), case_tables(), request.settings)[0], folder)
    found = check(folder.case_name(request.name), request.settings)
    try:
        text = as_set(case_of(request, folder))
    except InputError:
        text = None
    return {"answer": found.to_json(), "toml": text}


def signals(folder: Folder, body: Body) -> dict[str, Any]:
    """Return a recording's signals over time and the windows that are taken from it."""
    from asperity.tribometer.reduction.overview import overview

    request = request_of({**body, "command": "rig reduce"}, folder)
    recordings: Any = getattr(case_of(request, folder), "reducible", ())
    if len(recordings) != 1:
        raise InputError("signals are shown of one recording; name it")
    given = case_of(request_of({**body, "command": "rig plan", "arguments": {}}, folder), folder)
    shown = overview(recordings[0], _MOST_POINTS)
    return {"answer": shown, "command": request.line, "toml": as_set(given)}


def forms(folder: Folder, body: Body) -> dict[str, Any]:
    """Return every table of a case with its keys, and what data files hold for them."""
    from asperity.casefile.forms import forms
    from asperity.web.data_files import data_file_names

    return {"tables": forms(case_tables()), "listed": data_file_names()}


def opened(folder: Folder, body: Body) -> dict[str, Any]:
    """Return a case as it is written."""
    name = str(body["case"])
    return {"name": name, **as_written(folder.case(name), case_tables())}


def data(folder: Folder, body: Body) -> dict[str, Any]:
    """Return variables of the file a job left, with their coordinates; of all without values.

    Of one that has not ended, those of what is there so far.
    """
    found = folder.job(str(body["id"])).glob("*.nc")
    own = (path for path in found if path.is_file() and not path.is_symlink())
    paths = sorted(own, key=lambda path: (path.name == SO_FAR, path.name))
    if not paths:
        raise InputError("the job has left no data")
    return variables(paths[0], [name for name in str(body.get("names", "")).split(",") if name])


def thesis(folder: Folder, body: Body) -> dict[str, Any]:
    """Return what of the thesis is reproduced, and what of that was made here.

    Of claims that were not, what came of them where the page was made; as a page that prints if
    that is asked for.
    """
    from asperity.thesis.reproduce.ledger import ledger, reported

    shipped = json.loads(read_text(_SHIPPED / "thesis/answer.json"))["answer"]["claims"]
    found = ledger(folder.thesis, {one["id"]: one for one in shipped})
    return {"html": reported(found, folder.thesis)} if "report" in body else found


def received(folder: Folder, body: Body) -> dict[str, Any]:
    """Look at what was put into the folder before it takes its name."""
    from asperity.start.received import refuse_unreadable

    part, name, recorded = folder.inside(str(body["part"])), str(body["name"]), body["recorded"]
    refuse_unreadable(part, name, recorded=recorded, allowed=lambda case: confine(case, folder))
    return {"name": name}


def named(folder: Folder, body: Body) -> dict[str, Any]:
    """Return the name of a job: a key of all that its answer follows from."""
    request = request_of(body, folder)
    case = case_of(request, folder) if request.name else None
    return {"id": request.key(case), "line": request.line}
