// Values of outcomes that tests need. What is wrong with one fails the test that asks for it.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "config/diagnostics/diagnostic.h"

namespace skybake::test {

// Returns the value of an outcome without errors; lesser diagnostics may accompany it.
template <class T>
T without_errors(config::Outcome<T> outcome,
                 config::Severity unexpected = config::Severity::error) {
    EXPECT_TRUE(outcome.value.has_value());
    for (const config::Diagnostic& found : outcome.diagnostics) {
        if (found.severity == config::Severity::error || found.severity == unexpected) {
            ADD_FAILURE() << found.code << ": " << found.message;
        }
    }
    return outcome.value ? std::move(*outcome.value) : T{};
}

// Codes of diagnostics, each with a blank behind it.
inline std::string codes_of(const std::vector<config::Diagnostic>& diagnostics) {
    std::string codes;
    for (const config::Diagnostic& one : diagnostics) codes += one.code + " ";
    return codes;
}

// Returns the value of an outcome about which no diagnostic is said.
template <class T>
T without_diagnostics(config::Outcome<T> outcome) {
    return without_errors(std::move(outcome), config::Severity::warning);
}

}  // namespace skybake::test
