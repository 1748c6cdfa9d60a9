#include "cli/events.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>

#include "bakers/io/manifest/release.h"
#include "cli/diagnostic_printer.h"
#include "cli/options.h"
#include "config/diagnostics/diagnostic_codes.h"
#include "config/text/mapped.h"

namespace skybake::cli {
namespace {

using Json = nlohmann::ordered_json;

// Escapes everything except unreserved characters and the slashes between folders (RFC 3986).
std::string file_uri(std::string_view path) {
    std::string uri;
    for (const char sign : path) {
        const bool letter = (sign >= 'a' && sign <= 'z') || (sign >= 'A' && sign <= 'Z');
        const bool digit = sign >= '0' && sign <= '9';
        if (letter || digit || std::string_view("-._~/").find(sign) != std::string_view::npos) {
            uri += sign;
        } else {
            uri += fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(sign)));
        }
    }
    return uri;
}

Json sarif_location(const config::SourceRange& where) {
    if (!is_file(where.source)) return {{"message", {{"text", where.source}}}};
    Json place = {{"artifactLocation", {{"uri", file_uri(where.source)}}}};
    if (where.line > 0) {
        Json region = {{"startLine", where.line}};
        if (where.column > 0) {
            region["startColumn"] = where.column;
            region["endColumn"] = std::int64_t{where.column} + std::max(where.length, 1);
        }
        place["region"] = std::move(region);
    }
    return {{"physicalLocation", std::move(place)}};
}

Json sarif_result(const Diagnostic& diagnostic) {
    const std::string text = diagnostic.label.empty()
                                 ? diagnostic.message
                                 : fmt::format("{}; {}", diagnostic.message, diagnostic.label);
    Json result = {{"ruleId", diagnostic.code},
                   {"level", severity_word(diagnostic)},
                   {"message", {{"text", text}}},
                   {"locations", Json::array()}};
    if (!diagnostic.where.source.empty()) {
        result["locations"].push_back(sarif_location(diagnostic.where));
    }
    return result;
}

// Returns the codes that occur, each once, in order.
Json sarif_rules(std::span<const Diagnostic> diagnostics) {
    std::set<std::string> codes;
    for (const Diagnostic& diagnostic : diagnostics) codes.insert(diagnostic.code);
    Json rules = Json::array();
    for (const std::string& code : codes) {
        Json rule = {{"id", code}};
        if (const config::DiagnosticCode* entry = config::find_diagnostic_code(code)) {
            rule["shortDescription"] = {{"text", entry->title}};
            rule["fullDescription"] = {{"text", entry->explanation}};
        }
        rules.push_back(std::move(rule));
    }
    return rules;
}

Json diagnostic_json(const Diagnostic& diagnostic) {
    Json json = {{"severity", severity_word(diagnostic)},
                 {"code", diagnostic.code},
                 {"message", diagnostic.message},
                 {"label", diagnostic.label}};
    const config::SourceRange& where = diagnostic.where;
    if (where.source.empty()) return json;
    json[is_file(where.source) ? "file" : "source"] = where.source;
    const bool has_lines = is_file(where.source) || where.source == standard_input_name;
    if (!has_lines || where.line == 0) return json;
    json["line"] = where.line;
    if (where.column == 0) return json;
    json["column"] = where.column;
    json["length"] = where.length;
    return json;
}

}  // namespace

std::string event_line(const Json& event) {
    return event.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string failed_event(std::string_view command, ExitCode code,
                         std::span<const Diagnostic> diagnostics) {
    return event_line({{"event", "failed"},
                       {"command", command},
                       {"exit_code", static_cast<int>(code)},
                       {"diagnostics", diagnostics_json(diagnostics)}});
}

bool is_file(const std::string& source) {
    return !source.empty() && !source.starts_with("--") && !source.starts_with("preset ") &&
           source != standard_input_name;
}

Json diagnostics_json(std::span<const Diagnostic> diagnostics) {
    return mapped<Json>(diagnostics, diagnostic_json);
}

std::string print_json_lines(std::span<const Diagnostic> diagnostics) {
    std::string text;
    for (const Json& json : diagnostics_json(diagnostics)) text += event_line(json);
    return text;
}

std::string print_sarif(std::span<const Diagnostic> diagnostics) {
    const Json run = {
        {"tool",
         {{"driver",
           {{"name", tool_name()}, {"version", release()}, {"rules", sarif_rules(diagnostics)}}}}},
        {"columnKind", "unicodeCodePoints"},
        {"results", mapped<Json>(diagnostics, sarif_result)}};
    const Json document = {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                           {"version", "2.1.0"},
                           {"runs", Json::array({run})}};
    // Sources may hold any bytes. Those that are not UTF-8 become U+FFFD.
    return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace skybake::cli
