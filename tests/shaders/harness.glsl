// SPDX-License-Identifier: Apache-2.0
// Calls a function of shaders/lib once for each item. A test's shader defines INPUTS and OUTPUTS, the vec4s
// of an item, before it includes this file, and test_item(), which reads in_value() and sets out_value().
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer InputBlock {
    vec4 inputs[];
};
layout(std430, binding = 1) writeonly buffer OutputBlock {
    vec4 outputs[];
};
layout(location = 0) uniform uint item_count;

vec4 in_value(int k) {
    return inputs[gl_GlobalInvocationID.x * uint(INPUTS) + uint(k)];
}

void out_value(int k, vec4 value) {
    outputs[gl_GlobalInvocationID.x * uint(OUTPUTS) + uint(k)] = value;
}

void test_item();

void main() {
    if (gl_GlobalInvocationID.x < item_count) {
        test_item();
    }
}
