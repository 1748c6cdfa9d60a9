// skybake verify: proves that a folder's files are what its manifest says.
#include "bakers/io/verify.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "bakers/probe_check.h"
#include "bakers/skipping_check.h"
#include "cli/command.h"
#include "cli/console.h"

namespace skybake::cli {
namespace {

std::string as_json(const VerifyReport& report) {
    using Json = nlohmann::ordered_json;
    Json failures = Json::array();
    for (const VerifyFailure& failure : report.failures) {
        failures.push_back(
            {{"file", failure.file}, {"check", failure.check}, {"message", failure.message}});
    }
    const Json json = {{"files", report.files},
                       {"checks", report.checks},
                       {"passed", report.failures.empty()},
                       {"failures", std::move(failures)}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string as_text(const VerifyReport& report) {
    std::string text;
    for (const VerifyFailure& failure : report.failures) {
        text += fmt::format("{}: {}: {}\n", failure.file, failure.check, failure.message);
    }
    const std::string verdict =
        report.failures.empty() ? "all passed" : fmt::format("{} failed", report.failures.size());
    return text + fmt::format("{} file{}, {} checks, {}\n", report.files,
                              report.files == 1 ? "" : "s", report.checks, verdict);
}

ExitCode run_verify(const Invocation& invocation, Console& console) {
    const std::array checks = {probe_check()};
    const std::array of_folder = {skipping_check()};
    const auto outcome = verify_bake(invocation.arguments()[0], checks, of_folder);
    const ExitCode code = console.report(outcome.diagnostics);
    if (!outcome.value) return code;
    console.result(invocation.has("json") ? as_json(*outcome.value) : as_text(*outcome.value));
    return outcome.value->failures.empty() ? ExitCode::done : ExitCode::differs;
}

}  // namespace

Command verify_command() {
    return {
        .name = "verify",
        .brief = "prove baked files",
        .summary = "prove that baked files are what their manifest says",
        .arguments = {{.name = "path",
                       .help = "the output folder of a bake, or its manifest.json"}},
        .options = {{.name = "json", .help = "the report as JSON"}},
        .examples = {{"skybake verify out", "every failure of hash, metadata, values and probes"},
                     {"skybake verify out --json", "the same for a program"}},
        .exit_codes = {ExitCode::differs, ExitCode::io},
        .run = run_verify};
}

}  // namespace skybake::cli
