"""``python -m fem_run`` runs the command."""

from ._command import main

main()
