#include "bakers/workspace/sweep/variant_failure.h"

#include <nlohmann/json.hpp>
#include <system_error>

#include "bakers/io/files/atomic_file.h"
#include "bakers/io/files/output_folder.h"
#include "bakers/io/files/read_file.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using config::Diagnostic;

constexpr std::uintmax_t largest_failure = 1 << 20;

Json to_json(const Diagnostic& error) {
    return {{"code", error.code},           {"message", error.message},
            {"file", error.where.source},   {"line", error.where.line},
            {"column", error.where.column}, {"length", error.where.length},
            {"label", error.label}};
}

std::string text_at(const Json& json, const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

std::string failure_json(const std::vector<Diagnostic>& diagnostics) {
    Json errors = Json::array();
    for (const Diagnostic& diagnostic : diagnostics) {
        if (diagnostic.severity == config::Severity::error) errors.push_back(to_json(diagnostic));
    }
    const Json json = {{"format", 1}, {"errors", std::move(errors)}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<Diagnostic> read_failure(const fs::path& folder) {
    const auto text = read_file(folder / failure_name, largest_failure);
    const Json json = text.value ? Json::parse(*text.value, nullptr, false) : Json();
    const auto errors = json.is_object() ? json.find("errors") : json.end();
    std::vector<Diagnostic> diagnostics;
    if (!json.is_object() || errors == json.end() || !errors->is_array()) return diagnostics;
    for (const Json& error : *errors) {
        if (!error.is_object()) continue;
        Diagnostic diagnostic;
        diagnostic.code = text_at(error, "code");
        diagnostic.message = text_at(error, "message");
        diagnostic.where.source = text_at(error, "file");
        diagnostic.label = text_at(error, "label");
        diagnostics.push_back(std::move(diagnostic));
    }
    return diagnostics;
}

std::vector<Diagnostic> write_failure(const fs::path& folder,
                                      const std::vector<Diagnostic>& diagnostics) {
    const auto made = create_output_folder(folder);
    if (!made.value) return made.diagnostics;
    return write_file_atomically(folder / failure_name, failure_json(diagnostics)).diagnostics;
}

void remove_failure(const fs::path& folder) {
    std::error_code ignored;
    fs::remove(folder / failure_name, ignored);
}

}  // namespace skybake
