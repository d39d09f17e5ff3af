// SPDX-License-Identifier: Apache-2.0
#include "evaluate/scratch_folder.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"
#include "core/process.h"
#include "environment.h"
#include "temporary_folder.h"

namespace bounce {
namespace {

using test::Environment;
using test::TemporaryFolder;
namespace fs = std::filesystem;

// A process of its own that kills itself once it has done what it is for.
void run_killed(const std::function<void()>& work) {
    const pid_t child = fork();
    if (child == 0) {
        work();
        kill(getpid(), SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}

class ScratchFolderTest : public testing::Test {
  protected:
    [[nodiscard]] size_t entries() const {
        return static_cast<size_t>(std::distance(fs::directory_iterator(folder_.path()), {}));
    }

    TemporaryFolder folder_;
    Environment temporary_{"TMPDIR", folder_.path().string()};
};

TEST_F(ScratchFolderTest, IsRemovedWithAllInIt) {
    {
        const ScratchFolder scratch;
        EXPECT_EQ(scratch.path().parent_path(), folder_.path());
        EXPECT_THAT(scratch.path().filename().string(),
                    testing::MatchesRegex("bounce-" + std::to_string(getpid()) + "-......"));
        fs::create_directories(scratch / "a/b");
        std::ofstream(scratch / "a/b/c") << "text";
        EXPECT_EQ(entries(), 1U);
    }
    EXPECT_EQ(entries(), 0U);
}

TEST_F(ScratchFolderTest, OfAKilledProcessIsRemovedByTheNext) {
    run_killed([] {
        const ScratchFolder one;
        const ScratchFolder two;
        std::ofstream(one / "half.exr") << "text";
        fs::create_directory(two / "run0");
        kill(getpid(), SIGKILL);
    });
    EXPECT_EQ(entries(), 2U) << "this is what the test is about";
    EXPECT_EQ(remove_abandoned_scratch_folders(), 2U);
    EXPECT_EQ(entries(), 0U);
}

TEST_F(ScratchFolderTest, OfALiveProcessStays) {
    const ScratchFolder own;
    std::array<int, 2> ready{};
    std::array<int, 2> end{};
    ASSERT_EQ(pipe(ready.data()) + pipe(end.data()), 0);
    const pid_t child = fork();
    char byte = 0;
    if (child == 0) {
        const ScratchFolder scratch;
        (void)!write(ready[1], &byte, 1);
        (void)!read(end[0], &byte, 1);
        kill(getpid(), SIGKILL);
    }
    ASSERT_EQ(read(ready[0], &byte, 1), 1);
    EXPECT_EQ(remove_abandoned_scratch_folders(), 0U);
    EXPECT_EQ(entries(), 2U);
    ASSERT_EQ(write(end[1], &byte, 1), 1);
    waitpid(child, nullptr, 0);
    EXPECT_EQ(remove_abandoned_scratch_folders(), 1U);
    EXPECT_TRUE(fs::is_directory(own.path()));
    for (const int handle : {ready[0], ready[1], end[0], end[1]}) close(handle);
}

// A program that was started keeps working in the folder when the process that started it is killed.
TEST_F(ScratchFolderTest, StaysForAProgramThatOutlivesItsStarter) {
    std::array<int, 2> told{};
    ASSERT_EQ(pipe(told.data()), 0);
    run_killed([&] {
        const ScratchFolder scratch;
        (void)run_process({"sh", "-c", "echo $$; exec sleep 60"}, [&](std::string_view line) {
            (void)!write(told[1], line.data(), line.size());
            kill(getpid(), SIGKILL);
        });
    });
    std::array<char, 32> text{};
    ASSERT_GT(read(told[0], text.data(), text.size() - 1), 0);
    const pid_t sleeper = std::atoi(text.data());
    ASSERT_GT(sleeper, 1);
    EXPECT_EQ(remove_abandoned_scratch_folders(), 0U);
    EXPECT_EQ(entries(), 1U);
    kill(sleeper, SIGKILL);
    for (int i = 0; i < 500 && entries() > 0; ++i) {  // it ends when the system comes to it
        remove_abandoned_scratch_folders();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_EQ(entries(), 0U);
    close(told[0]);
    close(told[1]);
}

TEST_F(ScratchFolderTest, WhatIsNotOursStays) {
    fs::create_directory(folder_ / "elsewhere");
    std::ofstream(folder_ / "elsewhere/precious") << "text";
    for (const char* name : {"bounce-abcdef", "bounce-new-abcdef", "bounce-guard-abcdef", "bounce-12-abcde",
                             "bounce--abcdef", "bounce-12-abcdef-1", "bounce-12-abc.ef", "other-12-abcdef"}) {
        fs::create_directory(folder_ / name);
    }
    fs::create_directory_symlink(folder_ / "elsewhere", folder_ / "bounce-12-symlnk");
    std::ofstream(folder_ / "bounce-12-afilex") << "text";
    const bool root = geteuid() == 0;
    fs::create_directory(folder_ / "bounce-12-theirs");
    if (root) {  // only root can give a folder away
        ASSERT_EQ(chown((folder_ / "bounce-12-theirs").c_str(), 65534, 65534), 0);
    } else {
        fs::remove(folder_ / "bounce-12-theirs");
    }
    const size_t before = entries();
    EXPECT_EQ(remove_abandoned_scratch_folders(), 0U);
    EXPECT_EQ(entries(), before);
    // One with a link in it: the link goes, not what it leads to.
    fs::create_directory(folder_ / "bounce-12-abcdef");
    fs::create_directory_symlink(folder_ / "elsewhere", folder_ / "bounce-12-abcdef/link");
    EXPECT_EQ(remove_abandoned_scratch_folders(), 1U);
    EXPECT_EQ(entries(), before);
    EXPECT_TRUE(fs::is_regular_file(folder_ / "elsewhere/precious"));
}

// Many at once make, kill and remove: nobody's folder vanishes while it is in use.
TEST_F(ScratchFolderTest, NoneIsRemovedWhileItIsMade) {
    std::vector<pid_t> children;
    for (int i = 0; i < 4; ++i) {
        children.push_back(fork());
        if (children.back() == 0) {
            for (int k = 0; k < 200; ++k) {
                const ScratchFolder scratch;
                remove_abandoned_scratch_folders();
                std::ofstream(scratch / "file") << "text";
                if (!fs::is_regular_file(scratch / "file")) {
                    _exit(1);
                }
            }
            _exit(0);
        }
    }
    for (const pid_t child : children) {
        int status = 0;
        ASSERT_EQ(waitpid(child, &status, 0), child);
        EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 0);
    }
    EXPECT_EQ(entries(), 0U);
}

TEST_F(ScratchFolderTest, SaysWhereItCannotBeMade) {
    const Environment nowhere("TMPDIR", (folder_ / "none").string());
    EXPECT_THROW(const ScratchFolder scratch, Error);
    EXPECT_EQ(remove_abandoned_scratch_folders(), 0U);
}

}  // namespace
}  // namespace bounce
