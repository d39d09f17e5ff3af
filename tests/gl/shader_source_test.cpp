// SPDX-License-Identifier: Apache-2.0
//
// Shader files: packed, included, and named where they fail.
#include "gl/shader_source.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "gl/program.h"
#include "gl_context.h"
#include "temporary_folder.h"

namespace bounce::gl {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

std::string text_of(const fs::path& path) {
    const std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

TEST(EmbeddedShaders, AreTheFilesInTheSourceTree) {
    // Byte for byte: the build packs them through CMake, which has rules of its own for some characters.
    const fs::path root = fs::path(BOUNCE_SOURCE_DIR) / "shaders";
    int shaders = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
        const std::string extension = entry.path().extension().string();
        if (entry.is_regular_file() && extension != ".txt") {
            const std::string name = fs::relative(entry.path(), root).generic_string();
            EXPECT_EQ(embedded_shader(name), text_of(entry.path())) << name;
            ++shaders;
        }
    }
    EXPECT_GE(shaders, 20);
    EXPECT_TRUE(embedded_shader("passes/no_such.comp").empty());
}

// Reads shaders from a folder of the test's own.
class ShaderFolder : public test::GlTest {
  protected:
    void SetUp() override {
        GlTest::SetUp();
        setenv("BOUNCE_SHADER_DIR", folder_.path().c_str(), 1);
    }
    void TearDown() override {
        unsetenv("BOUNCE_SHADER_DIR");
        GlTest::TearDown();
    }
    void write(const std::string& name, const std::string& text) const {
        fs::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name) << text;
    }
    static Program compile(const std::string& path, const Defines& defines = {}) {
        return {path, {{GL_COMPUTE_SHADER, path}}, defines};
    }
    test::TemporaryFolder folder_;
};

TEST_F(ShaderFolder, VersionThenDefinesThenTheFile) {
    write("a.comp", "first\n#include \"lib/b.glsl\"\nlast\n");
    write("lib/b.glsl", "included\n");
    const ShaderSource source = load_shader("a.comp", {{"SIZE", "8"}, {"FAST", "1"}});
    EXPECT_EQ(source.text,
              "#version 450 core\n#define FAST 1\n#define SIZE 8\n#line 1 0\nfirst\n#line 1 "
              "1\nincluded\n#line 3 0\nlast\n");
    EXPECT_THAT(source.files, ElementsAre("a.comp", "lib/b.glsl"));
}

TEST_F(ShaderFolder, AFileIncludedTwiceKeepsItsNumber) {
    write("a.comp", "#include \"b.glsl\"\n#include \"b.glsl\"\n");
    write("b.glsl", "b\n");
    const ShaderSource source = load_shader("a.comp", {});
    EXPECT_THAT(source.files, ElementsAre("a.comp", "b.glsl"));
    EXPECT_THAT(source.text, HasSubstr("#line 1 1\nb\n#line 2 0\n#line 1 1\nb\n"));
}

TEST_F(ShaderFolder, AnErrorNamesFileAndLine) {
    write("good.comp", "layout(local_size_x = 1) in;\nvoid main() {\n    no_such_function();\n}\n");
    EXPECT_THAT([] { compile("good.comp"); },
                ThrowsMessage<Error>(
                    AllOf(HasSubstr("good.comp does not compile"), ContainsRegex("good.comp[:(]3"))));
}

TEST_F(ShaderFolder, AnErrorInAnIncludedFileNamesThatFile) {
    write("a.comp",
          "#include \"lib/good.glsl\"\n#include \"lib/broken.glsl\"\nlayout(local_size_x = 1) in;\nvoid "
          "main() {}\n");
    write("lib/good.glsl", "const float fine = 1.0;\n");
    write("lib/broken.glsl", "\n\nfloat f() { return no_such_name; }\n");
    EXPECT_THAT([] { compile("a.comp"); },
                ThrowsMessage<Error>(
                    AllOf(ContainsRegex("lib/broken.glsl[:(]3"), Not(ContainsRegex("lib/good.glsl[:(]")))));
}

TEST_F(ShaderFolder, AnErrorAfterAnIncludeHasTheLineOfItsOwnFile) {
    write("a.comp",
          "#include \"b.glsl\"\nlayout(local_size_x = 1) in;\nvoid main() {\n    no_such_function();\n}\n");
    write("b.glsl", "const float b = 1.0;\n\n\n\n\n");
    EXPECT_THAT([] { compile("a.comp"); }, ThrowsMessage<Error>(ContainsRegex("a.comp[:(]4")));
}

TEST_F(ShaderFolder, DefinesReachTheShader) {
    write("a.comp",
          "layout(local_size_x = GROUP) in;\n#ifndef SWITCH\n#error no switch\n#endif\nvoid main() {}\n");
    EXPECT_TRUE(compile("a.comp", {{"GROUP", "4"}, {"SWITCH", "1"}}));
    EXPECT_THAT([] { compile("a.comp", {{"GROUP", "4"}}); }, ThrowsMessage<Error>(HasSubstr("no switch")));
}

TEST_F(ShaderFolder, AMissingFileIsNamed) {
    write("a.comp", "#include \"lib/absent.glsl\"\n");
    EXPECT_THAT([] { (void)load_shader("a.comp", {}); }, ThrowsMessage<Error>(HasSubstr("lib/absent.glsl")));
    EXPECT_THAT([] { (void)load_shader("absent.comp", {}); }, ThrowsMessage<Error>(HasSubstr("absent.comp")));
}

TEST_F(ShaderFolder, AFileThatIncludesItselfIsRefused) {
    write("a.comp", "#include \"a.comp\"\n");
    EXPECT_THAT([] { (void)load_shader("a.comp", {}); }, ThrowsMessage<Error>(HasSubstr("circle")));
}

TEST_F(ShaderFolder, AProgramThatDoesNotLinkIsNamed) {
    write("a.vert", "out vec3 color;\nvoid main() { color = vec3(1.0); gl_Position = vec4(0.0); }\n");
    write("a.frag", "in vec4 color;\nout vec4 picture;\nvoid main() { picture = color; }\n");
    EXPECT_THAT(
        [] {
            const Program p("odd pair", {{GL_VERTEX_SHADER, "a.vert"}, {GL_FRAGMENT_SHADER, "a.frag"}}, {});
        },
        ThrowsMessage<Error>(HasSubstr("odd pair does not link")));
}

TEST(NameFilesInLog, OnlyNumbersAtTheStartThatStandForFiles) {
    const std::vector<std::string> files = {"a.comp", "lib/b.glsl"};
    EXPECT_EQ(name_files_in_log("1:3(5): error: x", files), "lib/b.glsl:3(5): error: x\n");          // Mesa
    EXPECT_EQ(name_files_in_log("0(12) : error C1008: y", files), "a.comp(12) : error C1008: y\n");  // NVIDIA
    EXPECT_EQ(name_files_in_log("7:3(5): error", files), "7:3(5): error\n");
    EXPECT_EQ(name_files_in_log("3 errors\n0:1: z", files), "3 errors\na.comp:1: z\n");
    EXPECT_EQ(name_files_in_log("", files), "");
}

}  // namespace
}  // namespace bounce::gl
