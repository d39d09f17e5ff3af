// SPDX-License-Identifier: Apache-2.0
//
// Runs a function of shaders/lib over numbers from C++ and returns what it says.
#pragma once

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl_context.h"
#include "temporary_folder.h"

namespace bounce::test {

inline constexpr double pi = std::numbers::pi;

class ShaderTest : public GlTest {
  protected:
    // A shader folder that holds the program's own files and, as tests/, those beside this header.
    void SetUp() override {
        GlTest::SetUp();
        const std::filesystem::path source(BOUNCE_SOURCE_DIR);
        for (const char* folder : {"lib", "shared"}) {
            std::filesystem::create_directory_symlink(source / "shaders" / folder, folder_ / folder);
        }
        std::filesystem::create_directory_symlink(source / "tests" / "shaders", folder_ / "tests");
        setenv("BOUNCE_SHADER_DIR", folder_.path().c_str(), 1);
    }
    void TearDown() override {
        unsetenv("BOUNCE_SHADER_DIR");
        GlTest::TearDown();
    }

    // Calls tests/<name> for each item of `inputs` vec4s; returns `outputs` vec4s an item.
    static std::vector<glm::vec4> run(const std::string& name, int inputs, int outputs,
                                      const std::vector<glm::vec4>& values, gl::Defines defines = {}) {
        defines["INPUTS"] = std::to_string(inputs);
        defines["OUTPUTS"] = std::to_string(outputs);
        const gl::Program program(name, {{GL_COMPUTE_SHADER, "tests/" + name}}, defines);
        const size_t items = values.size() / static_cast<size_t>(inputs);
        const gl::Buffer in = gl::Buffer::of("inputs", std::span<const glm::vec4>(values));
        // What no invocation writes stays NaN and is seen.
        const std::vector<glm::vec4> unset(items * static_cast<size_t>(outputs), glm::vec4(std::nanf("")));
        const gl::Buffer out = gl::Buffer::of("outputs", std::span<const glm::vec4>(unset));
        program.use();
        in.bind_storage(0);
        out.bind_storage(1);
        glUniform1ui(0, static_cast<GLuint>(items));
        glDispatchCompute(static_cast<GLuint>((items + 63) / 64), 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        gl::throw_on_debug_error(name);
        return out.read<glm::vec4>(unset.size());
    }

    // Unit vectors spread evenly over the sphere (a Fibonacci spiral), and the awkward ones: axes, edges and
    // corners of the cube, and neighbours of the poles.
    static std::vector<glm::dvec3> directions(int count) {
        std::vector<glm::dvec3> out;
        for (int i = 0; i < count; ++i) {
            const double z = 1.0 - 2.0 * (i + 0.5) / count;
            const double angle = 2.0 * pi * i * (std::numbers::phi - 1.0);
            const double r = std::sqrt(1.0 - z * z);
            out.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
        }
        for (int x = -1; x <= 1; ++x) {
            for (int y = -1; y <= 1; ++y) {
                for (int z = -1; z <= 1; ++z) {
                    if (x != 0 || y != 0 || z != 0) {
                        out.push_back(glm::normalize(glm::dvec3(x, y, z)));
                    }
                }
            }
        }
        for (const double tilt : {1e-3, 1e-6}) {
            for (const double z : {1.0, -1.0}) {
                out.push_back(glm::normalize(glm::dvec3(tilt, 0.0, z)));
                out.push_back(glm::normalize(glm::dvec3(-tilt, -tilt, z)));
            }
        }
        return out;
    }

    // Well-conditioned for small angles, unlike acos of the dot product.
    static double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
        return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    }

  private:
    TemporaryFolder folder_;
};

}  // namespace bounce::test
