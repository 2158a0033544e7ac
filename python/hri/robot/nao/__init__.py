# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What is NAO's alone: its protocol, its gestures, limits that concern two joints."""
