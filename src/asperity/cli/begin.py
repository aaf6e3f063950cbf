"""How a case is begun from a terminal: ``asperity new`` and ``asperity size``."""

from pathlib import Path
from typing import Annotated

import typer

from asperity.cli.outcome import reported
from asperity.cli.registry_commands import (
    JsonOption,
    LanguageOption,
    OutOption,
    SetOption,
    UnitsOption,
)

_TORQUE = typer.Option("--output-torque", metavar="TORQUE", help="Of the wheel, as '300 N m'.")
_POWER = typer.Option(
    "--input-power", metavar="POWER", help="Of the worm, in place of the torque, as '1.5 kW'."
)
_SPEED = typer.Option("--worm-speed", metavar="SPEED", help="As '1500 rpm'.")


@reported
def new(
    kind: Annotated[
        str,
        typer.Argument(
            metavar="KIND", help="gear, duty, slide, block, drive, rig, bearing or plastic."
        ),
    ],
    file: Annotated[
        str, typer.Argument(metavar="FILE", help="The file to write; KIND.toml if left out.")
    ] = "",
    ratio: Annotated[
        str, typer.Option("--ratio", metavar="RATIO", help="Of a gear's speeds; 40 if left out.")
    ] = "",
    output_torque: Annotated[str | None, _TORQUE] = None,
    worm_speed: Annotated[str | None, _SPEED] = None,
    read: Annotated[
        str, typer.Option("--from", metavar="FILE.rexs", help="A gear from another program's REXS.")
    ] = "",
    settings: SetOption = None,
    defaults: Annotated[bool, typer.Option("--defaults", help="Ask nothing.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Write a commented case file of your own, asking what is to be in it.

    A gear is sized from ratio, torque and speed; a duty is what asperity size takes.
    """
    from asperity.cli.new import new as run

    path = Path(file) if file else None
    asked = {"output_torque": output_torque, "worm_speed": worm_speed}
    run(kind, path, asked, settings or (), ratio, read, defaults=defaults, as_json=as_json)


@reported
def size(
    case: Annotated[
        str,
        typer.Argument(metavar="CASE", help="What is asked, as asperity new duty begins it."),
    ] = "",
    output_torque: Annotated[str | None, _TORQUE] = None,
    input_power: Annotated[str | None, _POWER] = None,
    worm_speed: Annotated[str | None, _SPEED] = None,
    ratio: Annotated[
        str,
        typer.Option("--ratio", metavar="RATIO", help="Of the speeds; else requirements.ratio."),
    ] = "",
    rank: Annotated[
        str, typer.Option("--rank", metavar="BY", help="size, efficiency or margin.")
    ] = "size",
    locks: Annotated[
        str, typer.Option("--locks", metavar="WHEN", help="rest or motion: it must lock itself.")
    ] = "",
    uncut: Annotated[
        bool, typer.Option("--uncut", help="Do not look whether a hob cuts each wheel.")
    ] = False,
    settings: SetOption = None,
    units: UnitsOption = "",
    language: LanguageOption = "",
    as_json: JsonOption = False,
    out: OutOption = None,
) -> None:
    """Propose worm gearsets for a ratio, a torque and a speed, rated by all standards.

    What the case or --set says of starts, teeth, centre distance, module, diameter factor or
    profile shift is held. The wheels of those that are shown are cut.

    With --out also report.html, size.json, size.nc and a case file for each proposal.
    """
    from asperity.cli.size import size as run

    asked = {"output_torque": output_torque, "input_power": input_power, "worm_speed": worm_speed}
    shown = units, language
    run(
        case, ratio, asked, settings or (), rank, locks, shown,
        cut=not uncut, as_json=as_json, out=out,
    )  # fmt: skip
