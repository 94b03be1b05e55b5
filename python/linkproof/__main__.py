"""`python -m linkproof` is the command `linkproof`."""

from linkproof._command import main

if __name__ == "__main__":
    main()
