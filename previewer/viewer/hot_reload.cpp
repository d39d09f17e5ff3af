// SPDX-License-Identifier: Apache-2.0
#include "viewer/hot_reload.h"

#include <chrono>
#include <new>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace bounce::viewer {
namespace fs = std::filesystem;
namespace {

// Exporters flush their buffers many times within this.
constexpr double k_rest_s = 0.3;

SceneReloader::Loaded load_or_say_why_not(const LoadScene& load) {
    try {
        return load();
    } catch (const Error& error) {
        return std::string(error.what());
    } catch (const std::bad_alloc&) {
        return std::string("there is not enough memory for the changed scene");
    } catch (const std::exception& error) {  // the file system, where the file goes away meanwhile
        return std::string(error.what());
    }
}

}  // namespace

FileWatch::FileWatch(fs::path path) : path_(std::move(path)), known_(look()) {}

std::optional<FileWatch::State> FileWatch::look() const {
    std::error_code code;
    const fs::file_time_type time = fs::last_write_time(path_, code);
    if (code) {
        return std::nullopt;
    }
    const std::uintmax_t bytes = fs::file_size(path_, code);
    return code ? std::nullopt : std::optional(State{time, bytes});
}

bool FileWatch::changed(double now_s) {
    const std::optional<State> current = look();
    if (!current || current == known_) {
        candidate_.reset();
        return false;
    }
    if (current != candidate_) {
        candidate_ = current;
        candidate_since_s_ = now_s;
        return false;
    }
    if (now_s - candidate_since_s_ < k_rest_s) {
        return false;
    }
    known_ = std::exchange(candidate_, std::nullopt);
    return true;
}

std::optional<SceneReloader::Loaded> SceneReloader::poll(double now_s) {
    if (loading_.valid()) {
        if (loading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
            return std::nullopt;
        }
        return loading_.get();
    }
    if (watch_.changed(now_s)) {
        loading_ = std::async(std::launch::async, load_or_say_why_not, load_);
    }
    return std::nullopt;
}

}  // namespace bounce::viewer
