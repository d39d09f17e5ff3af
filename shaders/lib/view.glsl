// SPDX-License-Identifier: Apache-2.0
#ifndef LIB_VIEW
#define LIB_VIEW

#include "shared/bindings.h"
#include "shared/types.h"

layout(std140, binding = UBO_VIEW) uniform ViewBlock {
    ViewUniforms view;
};

#endif
