"""Settings shared by all tests."""

import hypothesis

# Without a deadline, because the first example may load a unit registry or compile a kernel; the
# same examples every time, so that a failure is about the change at hand.
hypothesis.settings.register_profile("asperity", deadline=None, derandomize=True, database=None)
hypothesis.settings.load_profile("asperity")
