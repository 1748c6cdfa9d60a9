// Outcomes without a value.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "config/diagnostics/diagnostic.h"

namespace skybake::test {

// Expects that this code alone is said about an outcome without a value, and returns what is said.
template <class T>
config::Diagnostic expect_refused(const config::Outcome<T>& outcome, const std::string& code) {
    EXPECT_FALSE(outcome.value) << code;
    EXPECT_EQ(outcome.diagnostics.size(), 1U) << code;
    if (outcome.diagnostics.empty()) return {};
    EXPECT_EQ(outcome.diagnostics[0].code, code) << outcome.diagnostics[0].message;
    return outcome.diagnostics[0];
}

}  // namespace skybake::test
