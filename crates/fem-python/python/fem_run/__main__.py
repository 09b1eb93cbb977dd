"""``python -m fem_run`` is the command."""

from ._command import main

main()
