// This header declares the tables that diagnostic_codes.cpp joins to one, and the exit codes in them.
#pragma once

#include <span>

#include "config/diagnostics/diagnostic_codes.h"

namespace skybake::config {

inline constexpr int usage = 2;
inline constexpr int input_or_output = 3;
inline constexpr int failed_check = 4;
inline constexpr int internal = 5;

std::span<const DiagnosticCode> text_codes();
std::span<const DiagnosticCode> section_codes();
std::span<const DiagnosticCode> asset_codes();
std::span<const DiagnosticCode> run_codes();
std::span<const DiagnosticCode> warning_codes();

}  // namespace skybake::config
