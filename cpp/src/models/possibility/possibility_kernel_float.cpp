// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#define HRI_KERNEL_VALUE float
#include "models/possibility/possibility_kernel_of.inc"
