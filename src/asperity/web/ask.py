"""What a page may ask: what it names is one of its folder, refused before anything is read.

A case is one that ships or one of the folder, and every file that a table, a setting, an argument
or an option names lies in the folder.
"""

from asperity.casefile import Case
from asperity.commands.request import Body, CommandRequest
from asperity.web.folder import Folder


def request_of(body: Body, folder: Folder) -> CommandRequest:
    """Read what a page sent; raises InputError for what it may not ask."""
    request = CommandRequest.of(body)
    if request.command.case:
        folder.case(request.name)
    for text in request.texts():
        # Whatever it is taken for.
        for part in {text, *text.rpartition("=")[2].split(",")}:
            folder.inside(part.strip())
    return request


def case_of(request: CommandRequest, folder: Folder) -> Case:
    """Return the case that is asked for, confined to the folder."""
    case = request.case(folder.case_name(request.name) if request.name else "")
    confine(case, folder)
    return case


def confine(case: Case, folder: Folder) -> None:
    """Refuse a case of which any table names a file outside the folder.

    A case that ships brings its own files, which no setting has named; recordings bring the cases
    that they were made with.
    """
    ships = case.folder.resolve() != folder.path
    for key, path in case.files():
        if not ships or key in case.settings:
            folder.inside(path)
    for one in getattr(case, "reducible", ()):
        for _, path in one.case.files():
            folder.inside(path)
