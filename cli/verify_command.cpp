// skybake verify: checks a folder's files against its manifest.
#include "bakers/io/manifest/verify.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "bakers/assets/cloud_distance/distance_folder_check.h"
#include "bakers/assets/occupancy/occupancy_check.h"
#include "bakers/assets/registry/probe_check.h"
#include "bakers/io/formats/format.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/events.h"
#include "cli/progress.h"
#include "cli/table_printer.h"
#include "config/text/key_path.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;

std::string as_json(const VerifyReport& report) {
    using Json = nlohmann::ordered_json;
    Json failures = Json::array();
    for (const VerifyFailure& failure : report.failures) {
        failures.push_back(
            {{"file", failure.file}, {"check", failure.check}, {"message", failure.message}});
    }
    return event_line({{"event", "verified"},
                       {"files", report.files},
                       {"checks", report.checks},
                       {"passed", report.failures.empty()},
                       {"failures", std::move(failures)}});
}

std::string as_text(const VerifyReport& report) {
    std::string text;
    for (const VerifyFailure& failure : report.failures) {
        text += fmt::format("{}: {}: {}\n", failure.file, failure.check, failure.message);
    }
    const std::string verdict =
        report.failures.empty() ? "all passed" : fmt::format("{} failed", report.failures.size());
    return text + fmt::format("{}, {} checks, {}\n",
                              counted(static_cast<std::size_t>(report.files), "file"),
                              report.checks, verdict);
}

// Reports a recipe or a baked file that is given instead of the folder of a bake.
std::vector<Diagnostic> check_path(const fs::path& path) {
    const std::string extension = path.extension().string();
    const bool is_baked = extension.size() > 1 && find_format(extension.substr(1)) != nullptr;
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return {};
    if (extension == ".toml") {
        return {usage_error(fmt::format("`{}` is a recipe; verify takes the folder of its bake",
                                        config::printable(path.string())),
                            "skybake verify out; `skybake check` finds the errors of a recipe")};
    }
    if (!is_baked) return {};
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    return {usage_error(fmt::format("`{}` is one file of a bake; verify takes the folder",
                                    config::printable(path.string())),
                        fmt::format("skybake verify {}", config::printable(folder.string())))};
}

ExitCode run_verify(const Invocation& invocation, Console& console) {
    if (const ExitCode code = console.report(check_path(invocation.arguments()[0]));
        code != ExitCode::done) {
        return code;
    }
    const std::array checks = {probe_check()};
    const std::array of_folder = {skipping_check(), distance_folder_check()};
    const auto outcome = [&] {
        BakeProgress progress("verify", console);
        return verify_bake(invocation.arguments()[0], checks, of_folder, &progress);
    }();
    if (interrupted()) return ExitCode::interrupted;
    const ExitCode code = console.report(outcome.diagnostics);
    if (!outcome.value) return code;
    console.result(console.json() ? as_json(*outcome.value) : as_text(*outcome.value));
    return outcome.value->failures.empty() ? ExitCode::done : ExitCode::differs;
}

}  // namespace

Command verify_command() {
    return {.name = "verify",
            .brief = "check baked files",
            .summary = "check baked files against their manifest",
            .arguments = {{.name = "path",
                           .help = "the output folder of a bake, or its manifest.json"}},
            .examples = {{"skybake verify out",
                          "lists every mismatch in hashes, metadata, values and probes"},
                         {"skybake verify out --json", "reports the mismatches to a program"}},
            .exit_codes = {ExitCode::differs, ExitCode::io},
            .run = run_verify};
}

}  // namespace skybake::cli
