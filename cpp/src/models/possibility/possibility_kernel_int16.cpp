// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
#define HRI_KERNEL_VALUE std::int16_t
#include "models/possibility/possibility_kernel_of.inc"
