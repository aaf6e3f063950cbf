"""With which number a process of asperity ends: all of them, and what each says."""

DONE = 0
FAILED = 1  #: For another reason: no memory, no threads, a job that was killed.
BAD_INPUT = 2  #: What was given, a file or a folder cannot be used, or an extra is not installed.
NOT_DONE = 3  #: An iteration did not converge, an instrument did not answer, a part is left out.
STILL_ON = 4  #: An output of a rig may be on: nobody read back that it is off.
INTERRUPTED = 130  #: Ctrl-C, as shells say it (128 and the number of the signal).
BROKEN_PIPE = 141  #: Who read the output has seen enough, as shells say it.
TERMINATED = 143  #: SIGTERM, likewise, where other processes computed for it.

NO_LIBRARY = 3  #: Of a build alone: no library of kernels can be made here, as its last line says.
