// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace bounce {

// Passes and what they read and write, without OpenGL. A resource node is one version of a resource: a
// pass that changes a resource writes a new version, so order and need follow from the edges alone.
class DependencyGraph {
  public:
    // side_effect: runs whether or not anything reads what it writes.
    int add_pass(std::string name, bool side_effect = false);
    int add_resource(std::string name);
    void read(int pass, int resource);
    void write(int pass, int resource);
    void keep(int pass);  // sets the side effect later

    // True for each pass that runs: it has a side effect, or something that runs reads what it writes.
    // Counts references and strips what nothing refers to, backwards from the leaves.
    // at_hand: by resource, what is there already, so that nobody need write it for its readers; empty:
    // nothing.
    [[nodiscard]] std::vector<bool> live_passes(const std::vector<bool>& at_hand = {}) const;

    // Graphviz text, culled passes dashed.
    [[nodiscard]] std::string to_dot() const;

  private:
    struct Pass {
        std::string name;
        bool side_effect;
        std::vector<int> reads;
        std::vector<int> writes;
    };
    struct Resource {
        std::string name;
        int writer = -1;
        int readers = 0;
    };
    std::vector<Pass> passes_;
    std::vector<Resource> resources_;
};

}  // namespace bounce
