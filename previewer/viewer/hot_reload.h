// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "scene/gltf_loader.h"

namespace bounce::viewer {

// Tells when a file has changed and come to rest. Compares time of change and size; an exporter that
// writes for a while is waited for.
class FileWatch {
  public:
    // Make it before reading the file, so that a change in between is seen.
    explicit FileWatch(std::filesystem::path path);

    // True once for each change, when the file has stayed the same for a moment. A file that is not
    // there has not come to rest.
    bool changed(double now_s);

  private:
    struct State {
        std::filesystem::file_time_type time;
        std::uintmax_t bytes = 0;
        friend bool operator==(const State&, const State&) = default;
    };
    [[nodiscard]] std::optional<State> look() const;

    std::filesystem::path path_;
    std::optional<State> known_;
    std::optional<State> candidate_;
    double candidate_since_s_ = 0.0;
};

// Reads a scene; throws Error where it cannot be read. May be called on any thread.
using LoadScene = std::function<scene::LoadResult()>;

// Reads a scene again when its file changes, on a thread of its own, so that the window stays alive.
class SceneReloader {
  public:
    using Loaded = std::variant<scene::LoadResult, std::string>;  // or the sentence why not

    // Make it before reading the scene for the first time.
    SceneReloader(const std::filesystem::path& path, LoadScene load) : load_(std::move(load)), watch_(path) {}

    // What became of a change, once.
    std::optional<Loaded> poll(double now_s);
    [[nodiscard]] bool loading() const { return loading_.valid(); }

  private:
    LoadScene load_;
    FileWatch watch_;
    std::future<Loaded> loading_;
};

}  // namespace bounce::viewer
