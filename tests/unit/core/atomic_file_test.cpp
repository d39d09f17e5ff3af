// SPDX-License-Identifier: Apache-2.0
#include "core/atomic_file.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.h"

namespace bounce {
namespace fs = std::filesystem;
namespace {

class AtomicFileTest : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("bounce-atomic-" + std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    static std::string text_of(const fs::path& path) {
        std::ifstream in(path);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    [[nodiscard]] ptrdiff_t files() const {
        return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
    }

    fs::path folder_;
};

TEST_F(AtomicFileTest, AppearsOnCommitAlone) {
    const fs::path target = folder_ / "a.exr";
    {
        AtomicFile file(target);
        EXPECT_EQ(file.temporary_path().extension(), ".exr");
        EXPECT_EQ(file.temporary_path().parent_path(), folder_);
        std::ofstream(file.temporary_path()) << "whole";
        EXPECT_FALSE(fs::exists(target));
        file.commit();
    }
    EXPECT_EQ(text_of(target), "whole");
    EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFileTest, LeavesWhatWasThereWithoutCommit) {
    const fs::path target = folder_ / "a.txt";
    write_text_file(target, "before");
    {
        const AtomicFile file(target);
        std::ofstream(file.temporary_path()) << "half";
    }
    EXPECT_EQ(text_of(target), "before");
    EXPECT_EQ(files(), 1);
    write_text_file(target, "after");
    EXPECT_EQ(text_of(target), "after");
}

TEST_F(AtomicFileTest, CreatesFoldersAndRefusesImpossibleOnes) {
    write_text_file(folder_ / "x" / "y" / "a.txt", "deep");
    EXPECT_EQ(text_of(folder_ / "x" / "y" / "a.txt"), "deep");
    EXPECT_THROW(write_text_file(folder_ / "x" / "y" / "a.txt" / "b.txt", ""), Error);
    EXPECT_THROW(write_text_file(folder_ / "x", ""), Error);
    EXPECT_NO_THROW(require_writable(folder_ / "new" / "b.txt"));
    EXPECT_FALSE(fs::exists(folder_ / "new" / "b.txt"));
}

TEST_F(AtomicFileTest, TwoAtOnceDoNotMeet) {
    AtomicFile first(folder_ / "a.txt");
    AtomicFile second(folder_ / "a.txt");
    EXPECT_NE(first.temporary_path(), second.temporary_path());
    std::ofstream(first.temporary_path()) << "1";
    std::ofstream(second.temporary_path()) << "2";
    first.commit();
    second.commit();
    EXPECT_EQ(text_of(folder_ / "a.txt"), "2");
}

}  // namespace
}  // namespace bounce
