#include "bakers/assets/description/glsl_lookup.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <regex>
#include <sstream>
#include <utility>

namespace skybake {
namespace {

constexpr std::size_t kLineWidth = 100;

bool is_of_identifier(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// Published lookups consist of functions with blank lines between them and none within.
std::vector<std::string_view> paragraphs_of(std::string_view text) {
    std::vector<std::string_view> paragraphs;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find("\n\n"), text.size() - 1);
        paragraphs.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 2, text.size()));
    }
    return paragraphs;
}

std::string without_glsl_comments(std::string_view text) {
    std::istringstream lines{std::string(text)};
    std::string code;
    for (std::string line; std::getline(lines, line);)
        code += line.substr(0, line.find("//")) + '\n';
    return code;
}

// The functions that a paragraph defines: what stands before the bracket of a line that is not
// indented.
std::vector<std::string> defined_in(std::string_view paragraph) {
    std::istringstream lines(without_glsl_comments(paragraph));
    std::vector<std::string> names;
    for (std::string line; std::getline(lines, line);) {
        const std::size_t end = line.find('(');
        if (line.empty() || !is_of_identifier(line.front()) || end == std::string::npos) continue;
        std::size_t begin = end;
        while (begin > 0 && is_of_identifier(line[begin - 1])) --begin;
        names.push_back(line.substr(begin, end - begin));
    }
    return names;
}

bool calls(const std::string& code, const std::string& function) {
    for (std::size_t at = 0; (at = code.find(function + '(', at)) != std::string::npos; ++at) {
        if (at == 0 || !is_of_identifier(code[at - 1])) return true;
    }
    return false;
}

// Arguments in lines that are indented by so many blanks.
std::string broken(std::string_view arguments, std::size_t indent) {
    std::string text;
    std::size_t column = indent;
    while (!arguments.empty()) {
        const std::string_view one = arguments.substr(0, arguments.find(", "));
        arguments.remove_prefix(std::min(one.size() + 2, arguments.size()));
        const bool breaks = !text.empty() && column + one.size() + 3 > kLineWidth;
        if (!text.empty()) text += breaks ? ",\n" + std::string(indent, ' ') : ", ";
        column = (breaks ? indent : column) + one.size() + 2;
        text += one;
    }
    return text;
}

std::string text_of(const GlslFunction& function, const std::string& name) {
    const std::string head = fmt::format("{} {}{}(", function.result, name, function.suffix);
    return fmt::format("{}{}{}) {{\n{}    return {};\n}}\n", glsl_comment(function.comment), head,
                       broken(function.arguments, head.size()), function.before, function.value);
}

}  // namespace

std::string glsl_number(double value) {
    std::string text = fmt::format("{}", static_cast<float>(value));
    if (text.find('.') == std::string::npos)
        text.insert(std::min(text.find('e'), text.size()), ".0");
    return text;
}

std::string glsl_vector(const std::array<double, 3>& values) {
    return fmt::format("vec3({}, {}, {})", glsl_number(values[0]), glsl_number(values[1]),
                       glsl_number(values[2]));
}

std::string glsl_size(std::span<const int> size) {
    return fmt::format("vec{}({}.0)", size.size(), fmt::join(size, ".0, "));
}

std::string glsl_shell(const Shell& shell) {
    return glsl_number(shell.ground_radius_km) + ", " + glsl_number(shell.thickness_km);
}

GlslFunction with_channels(std::size_t channels, std::size_t components, GlslFunction function) {
    function.result = channels == 1 ? "float" : fmt::format("vec{}", channels);
    if (channels == 1) {
        function.value += ".r";
    } else if (channels == 2) {
        function.value += ".rg";
    } else if (channels != components) {
        function.value = fmt::format("vec{}({})", channels, function.value);
    }
    return function;
}

std::string_view of_4(std::size_t channels) { return channels == 4 ? "_of_4" : ""; }

GlslFunction with_wavelengths(std::size_t channels, GlslFunction function) {
    return with_channels(channels, channels == 4 ? 4 : 3, std::move(function));
}

std::string glsl_name(std::string_view asset) {
    std::string name = "baked";
    for (const char c : asset) {
        // GLSL keeps names with two underscores in a row for itself.
        const bool is_plain = is_of_identifier(c) && c != '_';
        if (name == "baked") name += '_';
        if (is_plain || name.back() != '_') name += is_plain ? c : '_';
    }
    return name;
}

std::string lookup_glsl(const AssetLookup& lookup, const std::string& name) {
    std::string text;
    for (const GlslFunction& function : lookup.functions) {
        text += (text.empty() ? "" : "\n") + text_of(function, name);
    }
    // Each function stands below those that it calls. The first paragraph says what holds for all.
    const auto paragraphs = paragraphs_of(published_lookup(fmt::format("{}.glsl", lookup.library)));
    for (std::size_t i = paragraphs.size(); i-- > 0;) {
        const std::string code = without_glsl_comments(text);
        const std::vector<std::string> names = defined_in(paragraphs[i]);
        const bool is_needed =
            std::ranges::any_of(names, [&](const auto& one) { return calls(code, one); });
        if (i == 0 || is_needed) text = std::string(paragraphs[i]) + "\n\n" + text;
    }
    return text;
}

LookupCost cost_of(const AssetLookup& lookup) {
    static const std::regex line(
        "// Cost[^:\\n]*: fetches (\\d+), operations (\\d+), divisions (\\d+), special functions "
        "(\\d+)");
    const std::string text = lookup_glsl({lookup.library, {lookup.functions.front()}}, "baked");
    LookupCost cost{.library = std::string(lookup.library)};
    for (std::sregex_iterator at(text.begin(), text.end(), line), end; at != end; ++at) {
        cost.fetches += std::stoi((*at)[1]);
        cost.operations += std::stoi((*at)[2]);
        cost.divisions += std::stoi((*at)[3]);
        cost.special_functions += std::stoi((*at)[4]);
    }
    return cost;
}

std::string cost_text(const LookupCost& cost) {
    return fmt::format("fetches {}, operations {}, divisions {}, special functions {}",
                       cost.fetches, cost.operations, cost.divisions, cost.special_functions);
}

std::string color_glsl(const ColorConvention& color, const std::vector<double>& wavelengths_nm,
                       bool is_packet, const std::string& name) {
    const std::size_t count = wavelengths_nm.size();
    std::vector<std::string> terms;
    for (std::size_t i = 0; i < count; ++i) {
        const double* weights = color.weights.data() + 3 * i;
        const std::string light = count == 1 ? "light" : fmt::format("light.{}", "xyzw"[i]);
        terms.push_back(
            fmt::format("{} * {}", light, glsl_vector({weights[0], weights[1], weights[2]})));
    }
    return glsl_comment(fmt::format(
               "Returns the colour ({}, white is the {}) of light at {} nm. March with the "
               "wavelengths, for a solar irradiance of 1 at each, and call this at the end.{}",
               color.space, color.white == "sun" ? "sun outside the air" : "space's own",
               fmt::join(wavelengths_nm, ", "),
               is_packet ? " Add what the other packets make of their wavelengths." : "")) +
           fmt::format("vec3 {}_color({} light) {{\n    return {};\n}}\n", name,
                       count == 1 ? "float" : fmt::format("vec{}", count),
                       fmt::join(terms, "\n         + "));
}

std::string glsl_comment(std::string_view text) {
    std::istringstream words{std::string(text)};
    std::string comment;
    std::string line = "//";
    for (std::string word; words >> word;) {
        if (line.size() + 1 + word.size() > kLineWidth) {
            comment += std::exchange(line, "//") + '\n';
        }
        line += ' ' + word;
    }
    return comment + line + '\n';
}

}  // namespace skybake
