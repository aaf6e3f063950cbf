"""What never repeats itself has not settled where the halves of its window agree by chance.

A ball that a shaken table throws has such motions: P. J. Holmes, J. Sound Vib. 84 (1982) 173.
"""

import numpy as np
import pytest
from apparatus.grid import slow

from asperity.casefile import read_case
from asperity.results.settled import Standing
from asperity.slider import TABLES, Model, judged_march, solve, solve_many
from asperity.slider.chance import judged, scatter
from asperity.slider.march import March
from asperity.slider.march_end import two_phases_on

BOUNCES = (
    "friction.model=coulomb", "friction.mu=0.221", "slider.normal_force=25 N",
    "slider.mass=0.671 kg", "slider.drive_velocity=8.03 mm/s", "slider.drive_stiffness=61 MN/m",
    "slider.drive_damping=1890 N s/m", "slider.lateral=guided", "normal.law=hertz",
    "normal.stiffness=53.3 MN/m", "normal.damping_ratio=0.28", "vibration.frequency=1881 Hz",
    "vibration.velocity_ratio=5", "vibration.direction=90 deg", "vibration.elevation=90 deg",
)  # fmt: skip


RINGS = (
    "friction.model=coulomb", "friction.mu=0.11936", "slider.normal_force=7.2493 N",
    "slider.mass=1.62564 kg", "slider.drive_velocity=0.045042 mm/s", "slider.lateral=guided",
    "slider.drive_stiffness=35.5349 MN/m", "slider.drive_damping=0 N s/m",
    "vibration.frequency=14215.6 Hz", "vibration.waveform=triangle", "vibration.start=0 s",
    "vibration.velocity_ratio=8.0681", "solve.step=0.17586 us",
)  # fmt: skip


def at_the_end(duration, *settings, name="normal-pin"):
    settings = (*settings, f"solve.duration={duration}")
    march = March(Model.from_case(read_case(name, TABLES, settings)))
    march.to(march.table.steps, 4096)
    return march


def told_of(march, ratio):
    sums = march.sums.copy()
    sums["drive_force"] = ratio * sums["steps"]
    return judged(Standing(True, "halves"), march._body, march.table, sums)


@pytest.mark.slow
def test_a_body_that_lands_in_five_cycles_is_told_by_their_mean():
    march = at_the_end("0.4 s", *BOUNCES)
    kept = march.state.copy()
    mean = 5.0 - scatter(march._body, march.table, 5.0)[0]
    assert march.state == kept
    # That of any window of whole fives, which is none of the march's.
    means = []
    for _ in range(200):
        march._body.clear()
        march.to(march.done + round(1.0 / (1881.0 * march.table.step)), 4096)
        means.append(float(march.sums["drive_force"] / march.sums["steps"]))
    assert np.ptp(means) > 1.0
    assert np.mean(means) == pytest.approx(mean, abs=1e-3)
    march = at_the_end("0.4 s", *BOUNCES)
    assert told_of(march, mean) == (Standing(True, "halves"), ())
    standing, (note,) = told_of(march, mean + 1e-3)
    assert standing.settled
    assert "repeats itself after 5 cycles" in note
    standing, notes = told_of(march, mean + 3e-3)
    assert not standing.settled
    assert "repeats itself after 5 cycles" in standing.settled_by
    assert not notes
    # What has not settled by its halves stays as it is.
    lacks = Standing(False, "halves")
    assert judged(lacks, march._body, march.table, march.sums) == (lacks, ())


@pytest.mark.slow
def test_windows_of_a_body_that_never_repeats_itself_differ():
    march = at_the_end("0.4 s", "vibration.velocity_ratio=30", "vibration.elevation=90 deg")
    far, why = scatter(march._body, march.table, 5.0)
    assert why == "its cycles do not repeat themselves"
    off, _ = scatter(march._body, march.table, 5.0 - far)
    assert 2e-3 < off < 0.05


@pytest.mark.slow
def test_a_lane_and_a_march_ask_whether_it_was_by_chance(monkeypatch):
    settings = "slider.drive_stiffness=20 MN/m", "solve.duration=0.6 s"
    models = [
        Model.from_case(
            read_case("table-4.3", TABLES, (*settings, f"vibration.velocity_ratio={k}"))
        )
        for k in (3, 6)
    ]
    monkeypatch.setattr(
        judged_march, "judged", lambda *given: (Standing(True, "luck"), ("a note",))
    )
    for answer in (*solve_many(models), solve(models[0], history=False)):
        assert answer.settled_by == "luck"
        assert "a note" in answer.notes


def test_halves_of_a_window_of_few_rings_that_agree_are_not_enough():
    # Four rings: each half of the window has two.
    model = Model.from_case(read_case("table-4.3", TABLES, (*RINGS, "solve.duration=7 ms")))
    answer = solve(model, history=False)
    assert answer.residual < 1e-3
    assert not answer.settled
    assert "its cycles do not repeat themselves" in answer.settled_by


BENDS = (
    "friction.law=vector", "friction.mu=0.44735", "slider.normal_force=82.653 N",
    "friction.exponent=2", "friction.max_deflection=0.50567 um", "slider.mass=0.086233 kg",
    "slider.drive_velocity=39.7527 mm/s", "slider.lateral=guided",
    "slider.drive_stiffness=2.14863 MN/m", "slider.drive_damping=216.42 N s/m",
    "vibration.frequency=11236.5 Hz", "vibration.waveform=triangle", "vibration.start=0 s",
    "vibration.velocity_ratio=0.411665", "solve.step=0.22249 us",
)  # fmt: skip


def test_asperities_that_bend_ever_more_are_further_off_than_the_next_cycles_show():
    model = Model.from_case(read_case("table-4.3", TABLES, (*BENDS, "solve.duration=6.5193 ms")))
    answer = solve(model, history=False)
    late = Model.from_case(read_case("table-4.3", TABLES, (*BENDS, "solve.duration=0.1 s")))
    assert answer.residual < 1e-3
    assert abs(solve(late, history=False).ratio - answer.ratio) > 2e-3
    assert not answer.settled
    assert any("would do, by the means" in note for note in answer.notes)


# By lot, of asperities with an exponent of 2 and 3 that a body free sideways bends to and fro.
WANDERS = {
    "vector": (
        "slider.drive_velocity=0.244080366056054 mm/s", "slider.normal_force=50.45091197699503 N",
        "slider.mass=0.00021122318374044316 kg", "slider.drive_stiffness=9373418.155762719 N/m",
        "friction.mu=0.2618246646979721", "friction.max_deflection=1.1158787657235795 um",
        "friction.law=vector", "friction.exponent=3", "vibration.frequency=6928.053803460919 Hz",
        "vibration.velocity_ratio=7.6153835896512785", "vibration.direction=1.3383200453285196 rad",
    ),
    "split": (
        "slider.drive_velocity=5.299975160396629e-06 m/s", "friction.law=split",
        "slider.normal_force=0.2962186004700058 N", "slider.mass=0.0005125888224596535 kg",
        "slider.drive_stiffness=1265079.9034766592 N/m", "friction.mu=0.34922885471313175",
        "friction.max_deflection=6.329542107585506e-08 m", "friction.exponent=3",
        "vibration.waveform=triangle", "vibration.frequency=2592.5631086349276 Hz",
        "vibration.velocity_ratio=2", "vibration.direction=3.69075549101348 rad",
    ),
    "soft": (
        "slider.drive_velocity=4.912343537285194e-06 m/s", "friction.law=split",
        "slider.normal_force=124.11922187062746 N", "slider.mass=2.0367326342577514 kg",
        "slider.drive_stiffness=40334308.01317038 N/m", "friction.mu=0.22113932626203964",
        "friction.max_deflection=9.79412380057002e-08 m", "friction.exponent=2",
        "vibration.frequency=288.7475489392841 Hz",
        "vibration.velocity_ratio=7.0764531723197095", "vibration.direction=5.453903971549482 rad",
    ),
    "settles": (
        "slider.drive_velocity=5.599597178584372e-06 m/s", "slider.mass=0.03958584394653091 kg",
        "slider.normal_force=0.5452766217290878 N", "slider.drive_stiffness=339795.4713399414 N/m",
        "friction.mu=0.19826251668008937", "friction.max_deflection=9.442713757412102e-08 m",
        "friction.law=vector", "friction.exponent=4", "friction.transfer=0.71",
        "vibration.frequency=457.9091991398636 Hz",
        "vibration.velocity_ratio=7.055529640922539", "vibration.direction=0 rad",
    ),
    "one way by chance": (
        "slider.drive_velocity=1.3071644672006349e-05 m/s", "slider.mass=0.016334380553180837 kg",
        "slider.normal_force=1.9296952059824417 N", "slider.drive_stiffness=258734.60203309363 N/m",
        "slider.drive_damping=1.5242606989968877 N s/m", "friction.mu=0.15062061754932238",
        "friction.max_deflection=1.4784723661576164e-07 m", "friction.law=split",
        "friction.exponent=2", "vibration.waveform=square",
        "vibration.frequency=465.4484588446172 Hz", "vibration.rise_time=0.0007790972094755414 s",
        "vibration.velocity_ratio=4.4950196144475445", "vibration.direction=0 rad",
    ),
    "to its limit": (
        "slider.drive_velocity=1.0469215850703245e-05 m/s", "slider.lateral=free",
        "slider.normal_force=0.1511286557997584 N", "slider.mass=0.00010969691645668698 kg",
        "slider.drive_stiffness=22027.471844650994 N/m", "friction.mu=0.19976256859429167",
        "friction.max_deflection=9.393016259104511e-07 m", "friction.law=vector",
        "friction.exponent=1.5", "vibration.waveform=square",
        "vibration.frequency=305.5468895251681 Hz", "vibration.rise_time=0.0006122909329220834 s",
        "vibration.velocity_ratio=0.44086712358114466",
        "vibration.direction=3.330044679000517 rad", "vibration.applied_to=body",
        "vibration.start=0.007527486218479561 s",
    ),
    "leaves its way": (
        "slider.drive_velocity=0.001883006129930489 m/s", "friction.law=vector",
        "slider.normal_force=0.2622213536357008 N", "slider.mass=3.0056992944738443e-06 kg",
        "slider.drive_stiffness=152.96413444924377 N/m", "friction.mu=0.06270061075879843",
        "friction.max_deflection=2.388875533245382e-06 m", "friction.exponent=1.5",
        "vibration.frequency=700.7474281422225 Hz", "vibration.velocity_ratio=5.816017867869196",
        "vibration.direction=180 deg",
    ),
    "goes somewhere": (
        "slider.drive_velocity=1.4730416287333953e-05 m/s", "friction.law=split",
        "slider.normal_force=0.0997481053611369 N", "slider.mass=2.9485028242155267e-05 kg",
        "slider.drive_stiffness=7955.957644294338 N/m", "friction.mu=0.05126444630786493",
        "friction.max_deflection=5.800298102154972e-07 m", "friction.exponent=1.5",
        "vibration.frequency=916.7407733718486 Hz",
        "vibration.velocity_ratio=3.2658480108107675",
        "vibration.direction=1.9838968764201002 rad",
    ),
}  # fmt: skip
ALL = (
    "friction.transfer=1", "slider.lateral=free", "slider.drive_damping=0 N s/m",
    "vibration.start=0 s",
)  # fmt: skip


def wanderer(body, duration, *settings):
    settings = (*ALL, *WANDERS[body], *settings, f"solve.duration={duration}")
    case = read_case("table-4.3", TABLES, settings)
    return solve(Model.from_case(case.replace_values({"solve.step": None})), history=False)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("body", "duration", "mean"),
    [
        ("vector", "0.84 s", 0.46),
        ("split", "0.82 s", 0.28),
        ("soft", "3.463233 s", 0.605),
        ("one way by chance", "2.068188311585238 s", 0.333),
    ],
)
def test_what_goes_on_wandering_is_told_no_duration_and_has_not_settled(body, duration, mean):
    """The first was settled, as its halves agreed; two were told a longer duration each.

    The means of four further windows of the last go one way, but those of their halves to and fro.
    """
    answer = wanderer(body, duration)
    assert not answer.settled
    assert answer.settled_by.startswith("the body goes on wandering: its cycles do not repeat")
    told = float(answer.settled_by.split(" in all")[0].split()[-1])
    assert told == pytest.approx(mean, abs=0.03)
    assert answer.notes[-1].startswith("no solve.duration is foreseen that would do")


def test_so_it_is_by_the_two_phase_scheme():
    answer = wanderer("soft", "1.3 s", "solve.scheme=two-phase", "solve.method=march")
    assert answer.settled_by.startswith("the body goes on wandering")
    assert answer.notes[-1].startswith("no solve.duration is foreseen that would do")


def test_so_it_is_where_a_window_has_fewer_cycles_than_are_looked_at():
    """The body is twenty times as slow in all, and its window has eight cycles."""
    slow_one = (
        "vibration.frequency=14.437377 Hz", "slider.mass=814.6930537 kg",
        "slider.drive_velocity=0.2456171768642597 um/s", "solve.scheme=two-phase",
        "solve.method=march",
    )  # fmt: skip
    answer = wanderer("soft", "5 s", *slow_one)
    assert "the means of 8 times 4 of them" in answer.settled_by


def test_the_cycles_after_a_march_of_two_phases_are_those_that_it_goes_on_with():
    given = "solve.scheme=two-phase", "solve.method=march", "friction.exponent=2"
    march = at_the_end("160.05 ms", *given, "friction.law=split", name="table-4.3")
    onward = two_phases_on(march._body, march.table)
    found = [next(onward) for _ in range(5)]
    for ratio in found:
        march._body.clear()
        march.to(march.done + round(1.0 / (march.model.frequency * march.table.step)), 4096)
        assert march.sums["drive_force"] / march.sums["steps"] == pytest.approx(ratio, rel=1e-9)


@pytest.mark.slow
def test_what_repeats_itself_a_window_later_is_not_told_that_it_wanders():
    """After nine cycles, from 1.3 s on; the 36 after 1.02 s do not repeat themselves."""
    answer = wanderer("settles", "1.02211 s")
    assert not answer.settled
    assert "wandering" not in answer.settled_by
    assert "a solve.duration of 1.5 s would do" in answer.notes[-1]
    assert wanderer("settles", "1.5 s").settled


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(
    ("body", "duration"),
    [("to its limit", "1.4864953913155228 s"), ("leaves its way", "1.145630708310306 s")],
)
def test_nor_are_rough_cycles_whose_windows_go_one_way_or_agree(body, duration):
    answer = wanderer(body, duration)
    assert not answer.settled
    assert "wandering" not in answer.settled_by


def test_one_that_wanders_is_told_the_usual_duration_before_it_has_had_that():
    answer = wanderer("split", "0.115716 s")
    assert not answer.settled
    assert "wandering" not in answer.settled_by
    assert "a solve.duration of 0.82 s would do" in answer.notes[-1]


@pytest.mark.slow
def test_rough_cycles_whose_means_still_go_somewhere_are_told_a_duration():
    """It goes from 0.855 to 0.882, where it repeats itself."""
    answer = wanderer("goes somewhere", "1.4 s")
    assert not answer.settled
    assert "wandering" not in answer.settled_by
    assert "would do, by the means" in answer.notes[-1]


STICKS = (
    "slider.drive_velocity=4.7810622 mm/s", "slider.normal_force=31.089146 N",
    "slider.drive_stiffness=522377.83 N/m", "slider.drive_damping=3.3459753 N s/m",
    "slider.mass=0.61738834 kg", "friction.model=lugre", "friction.mu=0.164",
    "friction.max_deflection=0.42436497 um", "friction.static_mu=0.1968",
    "friction.stribeck_velocity=0.84317672 mm/s", "friction.contact_damping=1448.467 N s/m",
    "friction.viscous_damping=3.674247 N s/m",
)  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("duration", ["0.8 s", slow("0.81 s")])
def test_slips_that_do_not_repeat_themselves_have_not_settled_by_chance(duration):
    """Of windows that settled by their halves the means were 5.5e-3 apart."""
    settings = (*STICKS, "vibration.velocity_ratio=0", f"solve.duration={duration}")
    found = solve(Model.from_case(read_case("table-4.3", TABLES, settings)))
    assert not found.settled
    assert "halves of the next window" in found.settled_by
    assert any("no solve.duration is foreseen" in note for note in found.notes)


@pytest.mark.slow
def test_nor_have_those_of_a_body_with_a_thousand_times_the_forces():
    heavy = (
        "slider.normal_force=31.089146 kN", "slider.drive_stiffness=522377830 N/m",
        "slider.drive_damping=3345.9753 N s/m", "slider.mass=617.38834 kg",
        "friction.contact_damping=1448467 N s/m", "friction.viscous_damping=3674.247 N s/m",
    )  # fmt: skip
    settings = (*STICKS, *heavy, "vibration.velocity_ratio=0", "solve.duration=0.8 s")
    found = solve(Model.from_case(read_case("table-4.3", TABLES, settings)))
    assert not found.settled
    assert "halves of the next window" in found.settled_by
