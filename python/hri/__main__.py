# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""`python -m hri` is the command line `hri`."""

from hri.cli.entry import run

if __name__ == "__main__":
    run()
