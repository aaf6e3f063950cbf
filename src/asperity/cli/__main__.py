"""``python -m asperity.cli``: the command line where the script is not installed."""

import sys

from asperity.cli.main import main

sys.exit(main())
