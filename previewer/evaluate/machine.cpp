// SPDX-License-Identifier: Apache-2.0
#include "evaluate/machine.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <thread>

namespace bounce {
namespace {

// The value of the first line that starts with key, behind separator and blanks.
std::string value_in(const char* file, std::string_view key, char separator) {
    std::ifstream in(file);
    std::string line;
    while (std::getline(in, line)) {
        const size_t at = line.find(separator);
        if (line.starts_with(key) && at != std::string::npos) {
            std::string value = line.substr(at + 1);
            std::erase(value, '"');
            const size_t start = value.find_first_not_of(" \t");
            return start == std::string::npos ? "" : value.substr(start);
        }
    }
    return "unknown";
}

}  // namespace

Machine this_machine() {
    return {value_in("/proc/cpuinfo", "model name", ':'),
            static_cast<int>(std::thread::hardware_concurrency()),
            value_in("/etc/os-release", "PRETTY_NAME", '=')};
}

std::string shell_line(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) {
        const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
            return std::isalnum(c) != 0 ||
                   std::string_view("-_./,:=+@%").find(static_cast<char>(c)) != std::string_view::npos;
        });
        line += line.empty() ? "" : " ";
        if (plain) {
            line += word;
            continue;
        }
        line += '\'';
        for (const char c : word) {
            line += c == '\'' ? std::string("'\\''") : std::string(1, c);
        }
        line += '\'';
    }
    return line;
}

std::string this_command() {
    std::ifstream in("/proc/self/cmdline", std::ios::binary);
    std::vector<std::string> words;
    std::string word;
    while (std::getline(in, word, '\0')) {
        words.push_back(word);
    }
    return shell_line(words);
}

}  // namespace bounce
