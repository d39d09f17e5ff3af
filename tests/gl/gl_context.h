// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "gl/context.h"
#include "gl/debug_output.h"

namespace bounce::test {

// One OpenGL context a process. A test binary that finds none fails: software GL is one of the packages
// that scripts/install_deps lists.
class GlTest : public testing::Test {
  protected:
    void SetUp() override {
        static const gl::HeadlessContext context;
        static const gl::DeviceInfo device = gl::initialise_current_context();
        ASSERT_FALSE(device.renderer.empty());
    }
    // A test that leaves an error behind has not tested what it says.
    void TearDown() override { EXPECT_NO_THROW(gl::throw_on_debug_error("the test")); }
};

}  // namespace bounce::test
