// SPDX-License-Identifier: Apache-2.0
//
// Which passes run, decided from reads and writes alone.
#include "frame_graph/dependency_graph.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace bounce {
namespace {

using testing::HasSubstr;
using testing::Not;
using Live = std::vector<bool>;

// A pass that reads some resources and makes one.
int produce(DependencyGraph& graph, int pass, const std::vector<int>& reads, const std::string& name) {
    for (const int resource : reads) {
        graph.read(pass, resource);
    }
    const int made = graph.add_resource(name);
    graph.write(pass, made);
    return made;
}

TEST(DependencyGraph, NothingIsLiveInAnEmptyGraph) {
    EXPECT_TRUE(DependencyGraph().live_passes().empty());
}

TEST(DependencyGraph, AChainThatNothingReadsIsCulledWhole) {
    DependencyGraph graph;
    const int a = produce(graph, graph.add_pass("a"), {}, "ra");
    const int b = produce(graph, graph.add_pass("b"), {a}, "rb");
    produce(graph, graph.add_pass("c"), {b}, "rc");
    EXPECT_EQ(graph.live_passes(), (Live{false, false, false}));
}

TEST(DependencyGraph, ASideEffectKeepsTheChainBeforeItAndNothingAfter) {
    DependencyGraph graph;
    const int a = produce(graph, graph.add_pass("a"), {}, "ra");
    const int b = produce(graph, graph.add_pass("b", true), {a}, "rb");
    produce(graph, graph.add_pass("c"), {b}, "rc");
    EXPECT_EQ(graph.live_passes(), (Live{true, true, false}));
}

TEST(DependencyGraph, KeepAddedLaterIsTheSameAsASideEffect) {
    DependencyGraph graph;
    const int first = graph.add_pass("a");
    const int a = produce(graph, first, {}, "ra");
    const int second = graph.add_pass("b");
    graph.read(second, a);
    EXPECT_EQ(graph.live_passes(), (Live{false, false}));
    graph.keep(second);
    EXPECT_EQ(graph.live_passes(), (Live{true, true}));
}

TEST(DependencyGraph, ADiamondLivesOrDiesAsOne) {
    for (const bool shown : {false, true}) {
        DependencyGraph graph;
        const int top = produce(graph, graph.add_pass("top"), {}, "r");
        const int left = produce(graph, graph.add_pass("left"), {top}, "left");
        const int right = produce(graph, graph.add_pass("right"), {top}, "right");
        produce(graph, graph.add_pass("bottom", shown), {left, right}, "picture");
        EXPECT_EQ(graph.live_passes(), Live(4, shown));
    }
}

TEST(DependencyGraph, HalfADiamondKeepsWhatItShares) {
    DependencyGraph graph;
    const int top = produce(graph, graph.add_pass("top"), {}, "r");
    produce(graph, graph.add_pass("unread"), {top}, "unread");
    const int right = produce(graph, graph.add_pass("right"), {top}, "right");
    produce(graph, graph.add_pass("bottom", true), {right}, "picture");
    EXPECT_EQ(graph.live_passes(), (Live{true, false, true, true}));
}

TEST(DependencyGraph, OneOfTwoOutputsReadIsEnough) {
    DependencyGraph graph;
    const int both = graph.add_pass("both");
    const int read = produce(graph, both, {}, "read");
    produce(graph, both, {}, "unread");
    produce(graph, graph.add_pass("show", true), {read}, "picture");
    EXPECT_EQ(graph.live_passes(), (Live{true, true}));
}

TEST(DependencyGraph, AnUnreadVersionDoesNotKeepItsWriter) {
    // second turns version 0 into version 1; only version 0 is shown.
    DependencyGraph graph;
    const int v0 = produce(graph, graph.add_pass("first"), {}, "r");
    const int show = graph.add_pass("show", true);
    graph.read(show, v0);
    produce(graph, graph.add_pass("second"), {v0}, "r");
    EXPECT_EQ(graph.live_passes(), (Live{true, true, false}));
}

TEST(DependencyGraph, AReadVersionKeepsEveryWriterBeforeIt) {
    DependencyGraph graph;
    const int v0 = produce(graph, graph.add_pass("first"), {}, "r");
    const int v1 = produce(graph, graph.add_pass("second"), {v0}, "r");
    graph.read(graph.add_pass("show", true), v1);
    EXPECT_EQ(graph.live_passes(), (Live{true, true, true}));
}

TEST(DependencyGraph, APassWithoutWritesAndWithoutSideEffectIsDeadAndKeepsNothing) {
    DependencyGraph graph;
    const int a = produce(graph, graph.add_pass("a"), {}, "ra");
    graph.read(graph.add_pass("look"), a);
    graph.add_pass("idle");
    EXPECT_EQ(graph.live_passes(), (Live{false, false, false}));
}

TEST(DependencyGraph, ReadingTwiceCountsTwiceAndStillDies) {
    DependencyGraph graph;
    const int a = produce(graph, graph.add_pass("a"), {}, "ra");
    produce(graph, graph.add_pass("b"), {a, a}, "rb");
    EXPECT_EQ(graph.live_passes(), (Live{false, false}));
}

TEST(DependencyGraph, AResourceWithoutAWriterIsAnImport) {
    DependencyGraph graph;
    const int imported = graph.add_resource("imported");
    graph.read(graph.add_pass("show", true), imported);
    produce(graph, graph.add_pass("unread"), {imported}, "r");
    EXPECT_EQ(graph.live_passes(), (Live{true, false}));
}

TEST(DependencyGraph, AskingDoesNotChangeTheAnswer) {
    DependencyGraph graph;
    const int a = produce(graph, graph.add_pass("a"), {}, "ra");
    graph.read(graph.add_pass("show", true), a);
    produce(graph, graph.add_pass("unread"), {a}, "r");
    const Live first = graph.live_passes();
    EXPECT_EQ(graph.live_passes(), first);
}

TEST(DependencyGraph, DotDrawsEdgesAndDashesWhatIsCulled) {
    DependencyGraph graph;
    const int a = produce(graph, graph.add_pass("make"), {}, "map");
    produce(graph, graph.add_pass("show", true), {a}, "picture");
    produce(graph, graph.add_pass("unread"), {a}, "lost");
    const std::string dot = graph.to_dot();
    EXPECT_THAT(dot, HasSubstr("digraph"));
    EXPECT_THAT(dot, HasSubstr(R"(p0 [shape=box, style="filled", label="make"])"));
    EXPECT_THAT(dot, HasSubstr(R"(p1 [shape=box, style="filled", label="show"])"));
    EXPECT_THAT(dot, HasSubstr(R"(p2 [shape=box, style="dashed", label="unread"])"));
    EXPECT_THAT(dot, HasSubstr("p0 -> r0;"));
    EXPECT_THAT(dot, HasSubstr("r0 -> p1;"));
    EXPECT_THAT(dot, HasSubstr("p1 -> r1;"));
    EXPECT_THAT(dot, Not(HasSubstr("r0 -> p0;")));
}

TEST(DependencyGraph, DotQuotesNamesThatCarryQuotes) {
    // Lights are named by their makers, and passes after lights.
    DependencyGraph graph;
    graph.add_pass(R"(rsm: 6" lamp \ left)");
    EXPECT_THAT(graph.to_dot(), HasSubstr(R"(label="rsm: 6\" lamp \\ left")"));
}

}  // namespace
}  // namespace bounce
