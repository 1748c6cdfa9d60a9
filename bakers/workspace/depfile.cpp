#include "bakers/workspace/depfile.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "bakers/io/files/load_module.h"

namespace skybake {
namespace {

namespace fs = std::filesystem;

// Escapes a name as GCC does, which all readers of depfiles understand: a backslash stands for
// itself unless the character after it is escaped.
std::string escaped(const fs::path& path) {
    const std::string& name = path.native();
    std::string text;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (name[i] == ' ' || name[i] == '#' || name[i] == ':') text += '\\';
        if (name[i] == '$') text += '$';
        if (name[i] == '\\') {
            const std::size_t next = std::min(name.find_first_not_of('\\', i), name.size() - 1);
            if (name[next] == ' ' || name[next] == '#') text += '\\';
        }
        text += name[i];
    }
    return text;
}

std::vector<fs::path> with_program(std::span<const fs::path> inputs) {
    std::vector<fs::path> all(inputs.begin(), inputs.end());
    for (fs::path& file : program_files()) all.push_back(std::move(file));
    return all;
}

}  // namespace

std::string depfile_text(std::span<const fs::path> targets, std::span<const fs::path> inputs) {
    const std::vector<fs::path> all = with_program(inputs);
    std::string text;
    for (const fs::path& target : targets) text += (text.empty() ? "" : " ") + escaped(target);
    text += ':';
    for (const fs::path& input : all) text += " \\\n  " + escaped(input);
    text += '\n';
    for (const fs::path& input : all) text += escaped(input) + ":\n";
    return text;
}

bool is_depfile(std::string_view text) {
    constexpr std::string_view end_of_targets = "manifest.json: \\\n";
    const std::size_t line = text.find('\n');
    return text.empty() || (line != std::string_view::npos && text.ends_with(":\n") &&
                            text.substr(0, line + 1).ends_with(end_of_targets));
}

}  // namespace skybake
