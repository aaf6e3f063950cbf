"""The disc-on-disc tribometer: configuration, recordings, reduction, laws fitted to data.

:Entry: `asperity rig plan`, `asperity rig run`, and so on; `asperity fit`.
:Data: `parameters`, `channels` and `options`: the rig, its sensors, what is done with it.
:Where: `plan`, `procedure` and `guardian` (who owns the outputs), `instruments` (a maker a file),
    `recording`, `importing` (a format a file), `checking`, `reduction`, `uncertainty`, `fit`,
    `report`, `package`, `twin` (simulated).
:Tests: `unit/test_rig_*`, `unit/test_tribometer_*`, `unit/test_fit_*`, `acceptance/test_cli_rig*`,
    `acceptance/test_rig_*`.
"""
