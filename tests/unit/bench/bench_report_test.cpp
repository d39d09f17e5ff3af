// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_report.h"

#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/process.h"
#include "temporary_folder.h"

namespace bounce::bench {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

BenchReport example() {
    BenchReport report;
    report.experiment = "rates";
    report.title = "Rates";
    report.scene = "box </script> & co.glb";  // a name that would break out of a careless page
    report.command = "bounce bench rates 'box </script> & co.glb' -o out";
    report.date = "2024-01-02T03:04:05Z";
    report.machine = {"A processor", 2, "A system"};
    report.gl_renderer = "A driver";
    report.timing = "by a clock";
    report.settings = {{"VPLs", "256"}};
    report.checks = {{"splat", 57.25, Check::Kind::at_least, 50.0, "M points/s"},
                     {"ratio", 1.5, Check::Kind::at_most, 1.2, "times"}};
    report.tables = {{"Times",
                      "a note",
                      {{"points", ""}, {"time", "ms"}, {"path", ""}},
                      {{512.0, 1.0, "disks"}, {32768.0, 123.456, "compute"}, {1024.0, nan, Cell{}}}}};
    Plot plot;
    plot.title = "Curve";
    plot.x_label = "points";
    plot.x_log = true;
    plot.series = {{"disks", {{512.0, 1.0}, {1024.0, nan}}}, {"paper", {{512.0, 2.0}}, true}};
    Plot bars;
    bars.title = "Bars";
    bars.kind = Plot::Kind::stacked;
    bars.bar_names = {"one", "two"};
    bars.series = {{"gather", {{0.0, 3.0}, {1.0, 4.0}}}};
    report.plots = {plot, bars};
    report.paper = {"On a GeForce 8800 GTX: 44 ms."};
    return report;
}

TEST(BenchNumber, HasSignificantDigitsAndNoExponent) {
    EXPECT_EQ(format_number(0.0123456), "0.0123");
    EXPECT_EQ(format_number(1.0), "1.00");
    EXPECT_EQ(format_number(12.345), "12.3");
    EXPECT_EQ(format_number(1234.5), "1234");
    EXPECT_EQ(format_number(-2.5), "-2.50");
    EXPECT_EQ(format_number(0.0), "0");
    EXPECT_EQ(format_number(nan), "not a number");
}

TEST(BenchTable, AlignsItsColumns) {
    EXPECT_EQ(table_text(example().tables[0]),
              "Times\n"
              "  points      time, ms  path\n"
              "     512          1.00  disks\n"
              "   32768           123  compute\n"
              "    1024  not a number  -\n"
              "  a note\n");
}

TEST(BenchCheck, SaysWhetherItIsMet) {
    const BenchReport report = example();
    EXPECT_EQ(check_text(report.checks[0]), "met     splat: 57.2 M points/s (at least 50)");
    EXPECT_EQ(check_text(report.checks[1]), "NOT MET ratio: 1.50 times (at most 1.20)");
    EXPECT_TRUE((Check{"", 2.0, Check::Kind::at_most, 2.0, ""}).met());
    EXPECT_FALSE((Check{"", nan, Check::Kind::at_most, 2.0, ""}).met());
    EXPECT_FALSE((Check{"", nan, Check::Kind::at_least, 2.0, ""}).met());
}

TEST(BenchText, NamesMachineDriverTimingAndPaper) {
    const std::string text = report_text(example());
    for (const char* part : {"A processor, 2 threads", "A driver", "by a clock", "GeForce 8800 GTX",
                             "NOT MET", "VPLs 256", "Times\n"}) {
        EXPECT_THAT(text, HasSubstr(part));
    }
}

TEST(BenchJson, KeepsTheContract) {
    const auto json = nlohmann::json::parse(report_json(example()).dump());
    EXPECT_EQ(json.at("schema"), "bounce.bench/1");
    EXPECT_EQ(json.at("experiment"), "rates");
    EXPECT_EQ(json.at("settings").at("VPLs"), "256");
    EXPECT_EQ(json.at("machine").at("cpu"), "A processor");
    EXPECT_EQ(json.at("gl").at("renderer"), "A driver");
    const auto& table = json.at("tables").at(0);
    EXPECT_EQ(table.at("columns").at(0).at("kind"), "count");
    EXPECT_EQ(table.at("columns").at(1).at("kind"), "number");
    EXPECT_EQ(table.at("columns").at(1).at("unit"), "ms");
    EXPECT_EQ(table.at("columns").at(2).at("kind"), "text");
    EXPECT_EQ(table.at("rows").at(1).at(1), 123.456) << "not rounded";
    EXPECT_TRUE(table.at("rows").at(2).at(1).is_null());
    EXPECT_TRUE(table.at("rows").at(2).at(2).is_null());
    const auto& plot = json.at("plots").at(0);
    EXPECT_EQ(plot.at("kind"), "lines");
    EXPECT_EQ(plot.at("x").at("log"), true);
    EXPECT_EQ(plot.at("series").at(1).at("from_paper"), true);
    EXPECT_EQ(json.at("plots").at(1).at("kind"), "stacked");
    EXPECT_EQ(json.at("checks").at(1).at("met"), false);
    EXPECT_EQ(json.at("checks").at(1).at("kind"), "at_most");
}

TEST(BenchHtml, IsSelfContainedAndHoldsTheData) {
    const std::string page = report_html(example());
    EXPECT_THAT(page, HasSubstr("bounce.bench/1"));
    EXPECT_THAT(page, HasSubstr("Chart.js v3"));
    EXPECT_THAT(page, HasSubstr("Permission is hereby granted"));
    for (const char* marker : {"/*STYLE*/", "/*CHART_NOTICE*/", "/*CHART_JS*/", "/*BENCH_JS*/", "/*RESULTS*/",
                               "src=\"http", "href=\"http", "box </script>"}) {
        EXPECT_THAT(page, Not(HasSubstr(marker)));
    }
}

TEST(BenchHtml, OpensInABrowser) {
    const auto chromium = find_program("chromium");
    if (!chromium) {
        GTEST_SKIP() << "chromium is not installed here";
    }
    const TemporaryFolder folder;
    write_bench_report(example(), folder / "report");
    EXPECT_TRUE(std::filesystem::exists(folder / "report" / "results.json"));
    const ProcessResult result = run_process(
        {chromium->string(), "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic",
         "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--user-data-dir=" + (folder / "profile").string(), "--virtual-time-budget=5000", "--dump-dom",
         "file://" + (folder / "report" / "index.html").string()});
    ASSERT_EQ(result.exit_code, 0) << result.output;
    EXPECT_THAT(result.output, Not(HasSubstr("Uncaught")));
    EXPECT_THAT(result.output, HasSubstr("57.3 M points/s</b>"));
    EXPECT_THAT(result.output, HasSubstr("not met: at most 1.20"));
    EXPECT_THAT(result.output, HasSubstr("<td class=\"number\">32768</td>"));
    EXPECT_THAT(result.output, HasSubstr("<td class=\"number\">–</td>"));
    EXPECT_THAT(result.output, HasSubstr("A processor, 2 threads, A system"));
    EXPECT_THAT(result.output, HasSubstr("aria-label=\"Bars\""));
}

}  // namespace
}  // namespace bounce::bench
