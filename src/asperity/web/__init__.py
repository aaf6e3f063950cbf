"""The page: a server on this machine alone, its warm worker, its jobs, and what a browser shows.

The page is made from ``commands`` and ``results``: every command can be a job, and those that
answer in milliseconds answer while a slider is dragged. What computes does so in processes of its
own, so that nothing a case asks can hold up or bring down the server.
"""
