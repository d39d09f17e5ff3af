// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/embedded.h"
#include "core/atomic_file.h"
#include "evaluate/embedded.h"
#include "evaluate/page.h"

namespace bounce::bench {
namespace {

using nlohmann::ordered_json;

std::string cell_text(const Cell& cell, bool count) {
    switch (cell.kind) {
        case Cell::Kind::number:
            return count ? fmt::format("{:.0f}", cell.number) : format_number(cell.number);
        case Cell::Kind::text:
            return cell.text;
        case Cell::Kind::empty:
            break;
    }
    return "-";
}

ordered_json number(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json cell_json(const Cell& cell) {
    switch (cell.kind) {
        case Cell::Kind::number:
            return number(cell.number);
        case Cell::Kind::text:
            return cell.text;
        case Cell::Kind::empty:
            break;
    }
    return nullptr;
}

std::string head_of(const Column& column) {
    return column.unit.empty() ? column.name : fmt::format("{}, {}", column.name, column.unit);
}

// Counts: no unit, and nothing behind the point.
bool is_count(const Table& table, size_t column) {
    return table.columns[column].unit.empty() &&
           std::all_of(table.rows.begin(), table.rows.end(), [&](const auto& row) {
               return row[column].kind != Cell::Kind::number ||
                      row[column].number == std::floor(row[column].number);
           });
}

// Numbers stand right under each other, words left.
bool is_text(const Table& table, size_t column) {
    return std::any_of(table.rows.begin(), table.rows.end(),
                       [&](const auto& row) { return row[column].kind == Cell::Kind::text; });
}

ordered_json table_json(const Table& table) {
    ordered_json columns = ordered_json::array();
    for (size_t i = 0; i < table.columns.size(); ++i) {
        columns.push_back({{"name", table.columns[i].name},
                           {"unit", table.columns[i].unit},
                           {"kind", is_text(table, i)    ? "text"
                                    : is_count(table, i) ? "count"
                                                         : "number"}});
    }
    ordered_json rows = ordered_json::array();
    for (const auto& row : table.rows) {
        ordered_json cells = ordered_json::array();
        for (const Cell& cell : row) {
            cells.push_back(cell_json(cell));
        }
        rows.push_back(std::move(cells));
    }
    return {{"title", table.title}, {"note", table.note}, {"columns", columns}, {"rows", rows}};
}

ordered_json plot_json(const Plot& plot) {
    ordered_json series = ordered_json::array();
    for (const Series& one : plot.series) {
        ordered_json points = ordered_json::array();
        for (const PlotPoint& point : one.points) {
            points.push_back({{"x", number(point.x)}, {"y", number(point.y)}});
        }
        series.push_back({{"name", one.name}, {"from_paper", one.from_paper}, {"points", points}});
    }
    return {{"title", plot.title},
            {"note", plot.note},
            {"kind", plot.kind == Plot::Kind::lines ? "lines" : "stacked"},
            {"x", {{"label", plot.x_label}, {"log", plot.x_log}}},
            {"y", {{"label", plot.y_label}, {"log", plot.y_log}}},
            {"bars", plot.bar_names},
            {"series", series}};
}

ordered_json check_json(const Check& check) {
    return {{"what", check.what},
            {"value", number(check.value)},
            {"kind", check.kind == Check::Kind::at_least ? "at_least" : "at_most"},
            {"limit", number(check.limit)},
            {"unit", check.unit},
            {"met", check.met()}};
}

}  // namespace

bool Check::met() const {
    return kind == Kind::at_least ? value >= limit : value <= limit;
}

std::string format_number(double value, int digits) {
    if (std::isnan(value)) {
        return "not a number";
    }
    if (value == 0.0 || std::isinf(value)) {
        return fmt::format("{}", value);
    }
    const int before_point = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
    return fmt::format("{:.{}f}", value, std::max(0, digits - before_point));
}

std::string table_text(const Table& table) {
    const size_t count = table.columns.size();
    std::vector<std::vector<std::string>> lines(1);
    for (const Column& column : table.columns) {
        lines[0].push_back(head_of(column));
    }
    for (const auto& row : table.rows) {
        auto& line = lines.emplace_back();
        for (size_t i = 0; i < count; ++i) {
            line.push_back(cell_text(row[i], is_count(table, i)));
        }
    }
    std::vector<size_t> widths(count);
    for (const auto& line : lines) {
        for (size_t i = 0; i < count; ++i) {
            widths[i] = std::max(widths[i], line[i].size());
        }
    }
    std::string out = table.title + "\n";
    for (const auto& line : lines) {
        std::string text;
        for (size_t i = 0; i < count; ++i) {
            text += is_text(table, i) ? fmt::format("  {:<{}}", line[i], widths[i])
                                      : fmt::format("  {:>{}}", line[i], widths[i]);
        }
        text.erase(text.find_last_not_of(' ') + 1);
        out += text + "\n";
    }
    return table.note.empty() ? out : out + "  " + table.note + "\n";
}

std::string check_text(const Check& check) {
    const auto shown = [](double value) {
        return value == std::floor(value) ? fmt::format("{:.0f}", value) : format_number(value);
    };
    return fmt::format("{} {}: {}{}{} ({} {})", check.met() ? "met    " : "NOT MET", check.what,
                       shown(check.value), check.unit.empty() ? "" : " ", check.unit,
                       check.kind == Check::Kind::at_least ? "at least" : "at most", shown(check.limit));
}

std::string report_text(const BenchReport& report) {
    std::string out = fmt::format("{}\n{}\n", report.title, std::string(report.title.size(), '='));
    const auto fact = [&](std::string_view name, const std::string& text) {
        out += fmt::format("{:<9}{}\n", name, text);
    };
    fact("scene", report.scene);
    std::string settings;
    for (const auto& [name, value] : report.settings) {
        settings += fmt::format("{}{} {}", settings.empty() ? "" : ", ", name, value);
    }
    fact("settings", settings);
    fact("machine", fmt::format("{}, {} threads, {}", report.machine.cpu, report.machine.threads,
                                report.machine.system));
    fact("OpenGL", fmt::format("{}, {}", report.gl_renderer, report.gl_version));
    fact("times", report.timing);
    for (const Table& table : report.tables) {
        out += "\n" + table_text(table);
    }
    const auto list = [&](std::string_view head, const std::vector<std::string>& lines) {
        if (!lines.empty()) {
            out += fmt::format("\n{}\n", head);
            for (const std::string& line : lines) {
                out += fmt::format("  {}\n", line);
            }
        }
    };
    list("The paper", report.paper);
    list("Notes", report.notes);
    std::vector<std::string> checks;
    for (const Check& check : report.checks) {
        checks.push_back(check_text(check));
    }
    list("To be reached", checks);
    return out;
}

ordered_json report_json(const BenchReport& report) {
    ordered_json settings = ordered_json::object();
    for (const auto& [name, value] : report.settings) {
        settings[name] = value;
    }
    ordered_json checks = ordered_json::array();
    for (const Check& check : report.checks) {
        checks.push_back(check_json(check));
    }
    ordered_json tables = ordered_json::array();
    for (const Table& table : report.tables) {
        tables.push_back(table_json(table));
    }
    ordered_json plots = ordered_json::array();
    for (const Plot& plot : report.plots) {
        plots.push_back(plot_json(plot));
    }
    return {
        {"schema", "bounce.bench/1"},
        {"experiment", report.experiment},
        {"title", report.title},
        {"scene", report.scene},
        {"settings", settings},
        {"checks", checks},
        {"tables", tables},
        {"plots", plots},
        {"paper", report.paper},
        {"notes", report.notes},
        {"timing", report.timing},
        {"machine",
         {{"cpu", report.machine.cpu},
          {"threads", report.machine.threads},
          {"system", report.machine.system}}},
        {"gl",
         {{"vendor", report.gl_vendor}, {"renderer", report.gl_renderer}, {"version", report.gl_version}}},
        {"command", report.command},
        {"date", report.date}};
}

std::string report_html(const BenchReport& report) {
    std::string page(embedded::bench_html());
    put_into_page(page, "/*STYLE*/", embedded::report_css());
    put_into_page(page, "/*CHART_NOTICE*/", embedded::chart_notice_txt());
    put_into_page(page, "/*CHART_JS*/", embedded::chart_js());
    put_into_page(page, "/*BENCH_JS*/", embedded::bench_js());
    // The data last: its text could hold a marker.
    put_into_page(page, "/*RESULTS*/", json_for_script(report_json(report)));
    return page;
}

void write_bench_report(const BenchReport& report, const std::filesystem::path& folder) {
    write_text_file(folder / "index.html", report_html(report));
    // Last: where it stands the report is whole.
    write_text_file(folder / "results.json", report_json(report).dump(2) + "\n");
}

}  // namespace bounce::bench
