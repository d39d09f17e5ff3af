// SPDX-License-Identifier: Apache-2.0
#ifndef LIB_VPL
#define LIB_VPL

#include "shared/bindings.h"
#include "shared/types.h"

layout(std430, binding = SSBO_VPLS) readonly buffer VplBlock {
    GpuVpl vpls[];
};

layout(std140, binding = UBO_ISM) uniform IsmBlock {
    IsmUniforms ism;
};

#endif
