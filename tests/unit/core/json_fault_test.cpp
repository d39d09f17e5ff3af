// SPDX-License-Identifier: Apache-2.0
#include "core/json_fault.h"

#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace bounce {
namespace {

using nlohmann::json;

std::string fault_of(const std::function<json()>& action) {
    try {
        (void)action();
    } catch (const json::exception& error) {
        return json_fault(error);
    }
    return "nothing was thrown";
}

std::string fault_of(const std::string& text) {
    return fault_of([&] { return json::parse(text); });
}

TEST(JsonFault, OfATextNamesThePlace) {
    EXPECT_EQ(fault_of("{\"a\": 1,\n \"b\": tru}"), "it is no valid JSON at line 2, column 10");
    EXPECT_EQ(fault_of("{\"a\": [1, 2"), "it breaks off at line 1, column 12");
    EXPECT_EQ(fault_of(""), "it breaks off at line 1, column 1");
    EXPECT_EQ(fault_of("[1e999]"), "the number 1e999 in it is too large");
}

TEST(JsonFault, OfWhatItHoldsIsInWords) {
    const json object{{"width", "wide"}, {"list", json::array()}};
    const auto of = [&](auto read) { return fault_of([&] { return json(read()); }); };
    EXPECT_EQ(of([&] { return object.at("height"); }), "it has no \"height\"");
    EXPECT_EQ(of([&] { return object.at("width").get<int>(); }), "a text stands where a number belongs");
    EXPECT_EQ(of([&] { return object.at("list").get<std::string>(); }), "a list stands where a text belongs");
    EXPECT_EQ(of([&] { return object.at("width").get<std::vector<int>>(); }),
              "a text stands where a list belongs");
    EXPECT_EQ(of([&] { return object.at("width").at("x"); }),
              "a text stands where an object or a list belongs");
    EXPECT_EQ(of([&] { return object.at("width").value("x", 1); }),
              "a text stands where an object or a list belongs");
    EXPECT_EQ(of([&] { return object.at("list").at("x"); }), "a list stands where an object belongs");
    EXPECT_EQ(of([&] { return object.at(0); }), "an object stands where a list belongs");
    EXPECT_EQ(of([&] { return json::parse("{", nullptr, false).at("x"); }), "it is no JSON");
    EXPECT_EQ(of([&] { return object.at("list").at(0); }), "a list in it is too short");
    EXPECT_EQ(of([&] { return json("\xff").dump(); }), "it has a text that is not UTF-8");
}

// Every kind of the library's errors: a sentence, and nothing of the library's own in it.
TEST(JsonFault, NeverHasTheLibrarysTag) {
    const std::vector<std::function<json()>> all{
        [] { return json::parse("nope"); },
        [] { return json::from_cbor(std::vector<uint8_t>{0x9f}); },
        [] { return json(3).at(json::json_pointer("/a")); },
        [] { return json(json::json_pointer("a").to_string()); },
        [] { return json(json(3).erase("a")); },
        [] {
            return json::object({{"a", json::object()}}).unflatten();
        },
    };
    for (size_t i = 0; i < all.size(); ++i) {
        const std::string told = fault_of(all[i]);
        EXPECT_THAT(told, testing::StartsWith("it ")) << i;
        EXPECT_THAT(told, testing::Not(testing::HasSubstr("json.exception"))) << i;
    }
}

}  // namespace
}  // namespace bounce
