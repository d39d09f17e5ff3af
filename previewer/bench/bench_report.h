// SPDX-License-Identifier: Apache-2.0
//
// What an experiment found, and its three forms: text for a terminal, results.json, and a page with plots.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "evaluate/machine.h"

namespace bounce::bench {

struct Column {
    std::string name;
    std::string unit;  // may be empty
};

// A number, a text, or nothing.
struct Cell {
    enum class Kind { empty, number, text };
    Kind kind = Kind::empty;
    double number = 0.0;
    std::string text;
    Cell() = default;
    Cell(double value) : kind(Kind::number), number(value) {}
    Cell(std::string value) : kind(Kind::text), text(std::move(value)) {}
    Cell(const char* value) : kind(Kind::text), text(value) {}
};

struct Table {
    std::string title;
    std::string note;
    std::vector<Column> columns;
    std::vector<std::vector<Cell>> rows;  // each as long as `columns`
};

struct PlotPoint {
    double x = 0.0;
    double y = 0.0;
};

struct Series {
    std::string name;
    std::vector<PlotPoint> points;
    bool from_paper = false;  // dashed and grey: somebody else's machine
};

struct Plot {
    enum class Kind {
        lines,
        stacked,  // bars of parts, one bar for each x that any series has
    };
    std::string title;
    std::string note;
    Kind kind = Kind::lines;
    std::string x_label;
    std::string y_label;
    bool x_log = false;
    bool y_log = false;
    std::vector<Series> series;
    std::vector<std::string> bar_names;  // of stacked bars: what stands under x = 0, 1, 2, ...
};

// A figure that the implementation is to reach. Reported, never a reason to fail.
struct Check {
    enum class Kind { at_least, at_most };
    std::string what;
    double value = 0.0;
    Kind kind = Kind::at_least;
    double limit = 0.0;
    std::string unit;
    // NaN is never met.
    [[nodiscard]] bool met() const;
};

struct BenchReport {
    std::string experiment;  // as named on the command line
    std::string title;
    std::string scene;    // file name, or what the generated scene is
    std::string command;  // as typed
    std::string date;     // UTC, ISO 8601
    Machine machine;
    std::string gl_vendor, gl_renderer, gl_version;
    std::string timing;                                         // how passes were timed, a sentence
    std::vector<std::pair<std::string, std::string>> settings;  // what held unless a table says otherwise
    std::vector<Check> checks;
    std::vector<Table> tables;
    std::vector<Plot> plots;
    std::vector<std::string> paper;  // what the paper says, with its hardware; sentences
    std::vector<std::string> notes;
    int bounds_broken = 0;  // outcomes beyond what must hold: the command then ends with above_threshold
};

// With this many significant digits, without exponents: 0.0123, 1.23, 123, 12345. "not a number" for NaN.
[[nodiscard]] std::string format_number(double value, int digits = 3);

// The table with its columns aligned, each line ended.
[[nodiscard]] std::string table_text(const Table& table);

[[nodiscard]] std::string check_text(const Check& check);

// All of the report but its plots.
[[nodiscard]] std::string report_text(const BenchReport& report);

// Schema bounce.bench/1 (docs/bench.md). A number that is not finite becomes null.
[[nodiscard]] nlohmann::ordered_json report_json(const BenchReport& report);

// One page that needs no other file and no network.
[[nodiscard]] std::string report_html(const BenchReport& report);

// Writes index.html and results.json into the folder. Throws output_error.
void write_bench_report(const BenchReport& report, const std::filesystem::path& folder);

}  // namespace bounce::bench
