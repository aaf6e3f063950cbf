"""The page: a server on this machine alone, its warm worker, its jobs, and what a browser shows.

The page is made from ``commands`` and ``results``: every command can be a job, and those that
answer in milliseconds answer while a slider is dragged. What computes does so in processes of its
own, so that nothing a case asks can hold up or bring down the server.

:Entry: `serve`, `asperity page`; `app` says what stands at which address.
:Data: one folder: cases, uploads, jobs (`folder`).
:Where: `guard` (who may ask), `ask` (what), `warm_worker` and `worker` (what answers), `jobs` and
    `job`, `static` (what the browser gets).
:Tests: `unit/test_web_*`, `acceptance/test_web_*`, `browser/`.
"""
