// SPDX-License-Identifier: Apache-2.0
#include "frame_graph/dependency_graph.h"

#include <cassert>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace bounce {
namespace {

size_t at(int index) {
    return static_cast<size_t>(index);
}

// A name between quotes in Graphviz text; passes carry the names of lights, which may hold anything.
std::string quoted(std::string_view name) {
    std::string out;
    for (const char c : name) {
        if (c == '"' || c == '\\') {
            out += '\\';
        }
        out += c;
    }
    return out;
}

}  // namespace

int DependencyGraph::add_pass(std::string name, bool side_effect) {
    passes_.push_back({std::move(name), side_effect, {}, {}});
    return static_cast<int>(passes_.size()) - 1;
}

int DependencyGraph::add_resource(std::string name) {
    resources_.push_back({std::move(name)});
    return static_cast<int>(resources_.size()) - 1;
}

void DependencyGraph::read(int pass, int resource) {
    passes_[at(pass)].reads.push_back(resource);
    ++resources_[at(resource)].readers;
}

void DependencyGraph::write(int pass, int resource) {
    assert(resources_[at(resource)].writer == -1 && "a version has one writer");
    passes_[at(pass)].writes.push_back(resource);
    resources_[at(resource)].writer = pass;
}

void DependencyGraph::keep(int pass) {
    passes_[at(pass)].side_effect = true;
}

std::vector<bool> DependencyGraph::live_passes(const std::vector<bool>& at_hand) const {
    std::vector<int> pass_references(passes_.size());
    std::vector<int> readers(resources_.size());
    for (size_t i = 0; i < passes_.size(); ++i) {
        pass_references[i] = static_cast<int>(passes_[i].writes.size()) + (passes_[i].side_effect ? 1 : 0);
    }
    std::vector<int> unread;
    for (size_t i = 0; i < resources_.size(); ++i) {
        readers[i] = resources_[i].readers;
        if (readers[i] == 0 || (!at_hand.empty() && at_hand[i])) {
            unread.push_back(static_cast<int>(i));
        }
    }
    const auto strip_reads = [&](const Pass& pass) {
        for (const int resource : pass.reads) {
            const bool counted = at_hand.empty() || !at_hand[at(resource)];
            if (--readers[at(resource)] == 0 && counted) {
                unread.push_back(resource);
            }
        }
    };
    // A pass that writes nothing and has no side effect is dead from the start.
    for (size_t i = 0; i < passes_.size(); ++i) {
        if (pass_references[i] == 0) {
            strip_reads(passes_[i]);
        }
    }
    while (!unread.empty()) {
        const int writer = resources_[at(unread.back())].writer;
        unread.pop_back();
        if (writer >= 0 && --pass_references[at(writer)] == 0) {
            strip_reads(passes_[at(writer)]);
        }
    }
    std::vector<bool> live(passes_.size());
    for (size_t i = 0; i < passes_.size(); ++i) {
        live[i] = pass_references[i] > 0;
    }
    return live;
}

std::string DependencyGraph::to_dot() const {
    const std::vector<bool> live = live_passes();
    std::string out = "digraph frame {\n  rankdir=LR;\n";
    for (size_t i = 0; i < passes_.size(); ++i) {
        out += fmt::format("  p{} [shape=box, style=\"{}\", label=\"{}\"];\n", i,
                           live[i] ? "filled" : "dashed", quoted(passes_[i].name));
    }
    for (size_t i = 0; i < resources_.size(); ++i) {
        out += fmt::format("  r{} [shape=ellipse, label=\"{}\"];\n", i, quoted(resources_[i].name));
    }
    for (size_t i = 0; i < passes_.size(); ++i) {
        for (const int resource : passes_[i].reads) {
            out += fmt::format("  r{} -> p{};\n", resource, i);
        }
        for (const int resource : passes_[i].writes) {
            out += fmt::format("  p{} -> r{};\n", i, resource);
        }
    }
    return out + "}\n";
}

}  // namespace bounce
