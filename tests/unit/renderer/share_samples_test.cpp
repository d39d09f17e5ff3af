// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/light_setup.h"

namespace bounce {
namespace {

using Shares = std::vector<int>;

TEST(ShareSamples, ByFlux) {
    EXPECT_EQ(share_samples({}, 224), Shares{});
    EXPECT_EQ(share_samples({5.0}, 224), Shares{224});
    EXPECT_EQ(share_samples({3.0, 1.0}, 200), (Shares{141, 50}))
        << "0.75 is nearest to half an octave below 1";
}

TEST(ShareSamples, ADimLightKeepsASixteenthOfItsEvenShare) {
    // Two lights, 320 samples: an even share is 160.
    EXPECT_EQ(share_samples({1e6, 1e-6}, 320), (Shares{320, 10}));
}

TEST(ShareSamples, EveryLightHasASampleHoweverMany) {
    const Shares shares = share_samples(std::vector<double>(1000, 1.0), 64);
    for (const int share : shares) {
        EXPECT_EQ(share, 1);
    }
}

TEST(ShareSamples, ASlowChangeKeepsTheCounts) {
    const Shares before = share_samples({100.0, 130.0}, 224);
    EXPECT_EQ(share_samples({101.0, 130.0}, 224), before);
}

TEST(ShareSamples, LightsWithoutFluxShareAlike) {
    EXPECT_EQ(share_samples({0.0, 0.0}, 100), (Shares{50, 50}));
}

TEST(ShareSamples, HugeFluxesDoNotOverflow) {
    // 10^300 W twice: their sum is still a number, their shares are halves.
    EXPECT_EQ(share_samples({1e300, 1e300}, 100), (Shares{50, 50}));
}

}  // namespace
}  // namespace bounce
