"""The devices of a configuration that a guardian owns."""

import functools
from collections.abc import Mapping
from typing import Any

from asperity.casefile import Case
from asperity.tribometer.guardian.owned import LISTENER, Device
from asperity.tribometer.guardian.remote import RemoteListener, RemoteSupply, RemoteVibration
from asperity.tribometer.guardian.rig import Address, RigLine
from asperity.tribometer.guardian.scopes import opened_scope
from asperity.tribometer.instruments.acquisition import Acquisition, inputs_for
from asperity.tribometer.instruments.listening import ScopeListener
from asperity.tribometer.instruments.parameters import Controller, Guard, Output, Supplies
from asperity.tribometer.options import Plan
from asperity.tribometer.parameters import Sonotrode

DRIVE = "vibration controller"
OUTPUTS = {
    "amplifier": "supply of the amplifier",
    "steel": "supply of the steel disc's motor",
    "bronze": "supply of the bronze disc's motor",
}
"""What messages call them."""
EAR = "ear at the drive signal"


def owned_by(case: Case, backend: str) -> tuple[dict[str, str], tuple[str, ...]]:
    """Return the outputs that a guardian owns, by key with their names, and those of a person."""
    every = {"vibration": DRIVE, **OUTPUTS}
    if backend == "sim":
        return every, ()
    owned = {}
    if backend == "hardware" and Controller.table in case:
        owned["vibration"] = DRIVE
    if backend == "hardware" and Supplies.table in case:
        table = case.require(Supplies)
        owned |= {key: OUTPUTS[key] for key in OUTPUTS if getattr(table, key)}
    remote = (name for key, name in every.items() if key not in owned and key != "amplifier")
    return owned, tuple(remote)


def deadline_of(case: Case, *, simulated: bool) -> float:
    """Return how long an instrument may take to answer, s."""
    due = case.get(Guard, Guard()).due(simulated=simulated)
    if simulated or case.get(Guard, Guard()).deadline is not None:
        return due
    slow = (
        [one.takes for one in case.require(Supplies).outputs.values()]
        if (Supplies.table in case)
        else []
    )
    if Controller.table in case:
        slow.append(case.require(Controller).takes)
    return max([due, *slow])


def devices_of(case: Case, backend: str, rig: Address | None) -> list[Device]:
    """Return the devices, each of which begins to be opened."""
    owned, _ = owned_by(case, backend)
    if rig is not None:
        return [_simulated(key, name, rig) for key, name in {**owned, LISTENER: EAR}.items()]
    found = []
    if "vibration" in owned:
        found.append(Device(DRIVE, {"vibration": DRIVE}, lambda: _controller(case)))
    outputs = {key: name for key, name in owned.items() if key in OUTPUTS}
    if outputs:
        found += _supplies(case.require(Supplies), outputs)
    # What is written into a folder comes too late to be listened to.
    if not case.get(Acquisition, Acquisition()).folder:
        found.append(Device("oscilloscope", {LISTENER: EAR}, lambda: _ear(case)))
    return found


def _simulated(key: str, name: str, rig: Address) -> Device:
    kinds: Mapping[str, Any] = {"vibration": RemoteVibration, LISTENER: RemoteListener}
    made = kinds.get(key, RemoteSupply)

    def opened() -> dict[str, Any]:
        one = made(RigLine(rig), key, name)
        one.identify()
        return {key: one}

    return Device(name, {key: name}, opened)


def _controller(case: Case) -> dict[str, Any]:
    from asperity.tribometer.instruments.serial_vibration import Levels, SerialVibration

    levels = Levels.of(case.require(Sonotrode))
    return {"vibration": SerialVibration(case.require(Controller), levels)}


def _supplies(table: Supplies, outputs: Mapping[str, str]) -> list[Device]:
    if table.driver:
        return [Device("supplies", outputs, lambda: _driven(table))]
    # Outputs at one address are one device, with one line.
    places: dict[str, dict[str, Output]] = {}
    for key, words in table.outputs.items():
        places.setdefault(words.where, {})[key] = words
    return [
        Device(
            f"supply at {where}",
            {key: outputs[key] for key in there},
            functools.partial(_described, there),
        )
        for where, there in places.items()
    ]


def _driven(table: Supplies) -> dict[str, Any]:
    from asperity.tribometer.instruments.pymeasure_supply import open_supplies

    return dict(open_supplies(table))


def _described(there: Mapping[str, Output]) -> dict[str, Any]:
    from asperity.tribometer.instruments.described_supply import open_described

    return dict(open_described(there))


def _ear(case: Case) -> dict[str, Any]:
    sonotrode = case.require(Sonotrode)
    opened = functools.partial(opened_scope, case)
    plan = case.get(Plan, Plan())
    ear = ScopeListener(
        inputs_for(case), sonotrode, opened, plan.sample_rate, tuple(plan.frequencies)
    )
    return {LISTENER: ear}
