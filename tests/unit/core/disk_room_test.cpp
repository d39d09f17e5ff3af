// SPDX-License-Identifier: Apache-2.0
#include "core/disk_room.h"

#include <gtest/gtest.h>

#include "core/atomic_file.h"
#include "core/error.h"
#include "file_size_limit.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

namespace fs = std::filesystem;

TEST(DiskRoom, SaysWhatTheSystemSays) {
    const test::TemporaryFolder folder;
    EXPECT_FALSE(check_room(folder.path(), 100000));
    EXPECT_TRUE(check_room(folder / "none", 1) == std::errc::no_such_file_or_directory);
    {
        const test::FileSizeLimit limit(50000);
        EXPECT_FALSE(check_room(folder.path(), 50000));
        EXPECT_TRUE(check_room(folder.path(), 50001) == std::errc::file_too_large);
    }
    EXPECT_TRUE(fs::is_empty(folder.path())) << "nothing of it stays";
}

TEST(WriteFile, KeepsWhatWasThereWhereTheDiskTakesAPart) {
    const test::TemporaryFolder folder;
    write_file(folder / "a.txt", "before");
    {
        const test::FileSizeLimit limit(5000);
        EXPECT_THROW(write_file(folder / "a.txt", std::string(5001, 'x')), Error);
        EXPECT_THROW(write_file(folder / "a.txt", std::string(100000, 'x')), Error);
    }
    EXPECT_EQ(fs::file_size(folder / "a.txt"), 6U);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace bounce
