#include "config/recipe/recipe_sources.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "config/diagnostics/toml_source.h"
#include "config/fields/fields.h"
#include "config/presets/presets.h"
#include "config/recipe/merge.h"
#include "config/sections/towers.h"
#include "config/text/key_path.h"
#include "config/text/text.h"

namespace skybake::config {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 256;

// Gives every place of a tree that was parsed without a source the place of a --set.
void assign_place(Value& value, const Place& place);

void assign_place(Table& table, const Place& place) {
    for (Entry& entry : table) {
        entry.key_place = place;
        assign_place(entry.value, place);
    }
}

void assign_place(Value& value, const Place& place) {
    value.place = place;
    if (auto* table = std::get_if<Table>(&value.data)) assign_place(*table, place);
    if (auto* array = std::get_if<Array>(&value.data)) {
        for (Value& item : *array) assign_place(item, place);
    }
}

// Makes the tree a.b.c = value.
Table wrap(const std::vector<std::string>& names, Value value) {
    Table table;
    for (auto name = names.rbegin(); name != names.rend(); ++name) {
        Entry entry{*name, {}, std::move(value)};
        table.clear();
        table.push_back(std::move(entry));
        value = Value{std::move(table), {}};
        table = {};
    }
    return std::get<Table>(std::move(value.data));
}

// Whether two paths lead to the same file. A file that does not exist is not the same as any other.
bool is_same_file(const fs::path& a, const fs::path& b) {
    std::error_code error;
    return fs::equivalent(a, b, error) && !error;
}

// Whether a path is one that a program might wait at for ever. A recipe may come from a pipe, an include
// of it may not.
bool is_pipe_or_device(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

constexpr const char* no_recipe = "an include must be a recipe; lines of other files are not shown";

bool has_key_of_recipes(const Table& root) {
    const Section& section = *find_section("");
    const std::vector<std::string_view> tables = subtables("");
    return std::ranges::any_of(root, [&](const Entry& entry) {
        return find_field(section, entry.key) != nullptr ||
               std::ranges::find(tables, entry.key) != tables.end();
    });
}

class Loader {
  public:
    Loader(RecipeSources& result, DiagnosticList& diagnostics)
        : result_(result), diagnostics_(diagnostics) {}

    // The texts of --set are read first, because they may name another preset or other includes.
    void read_settings(std::span<const std::string> settings, std::string_view option) {
        for (const std::string& setting : settings) read_setting(setting, option);
    }

    void load_file(const fs::path& path, const Place& asked_at) {
        if (root_loaded_ && is_pipe_or_device(path)) {
            report_unreadable(path, {false, "it is not a regular file"}, asked_at);
            return;
        }
        auto text = read_text_file(path, most_recipe_bytes);
        result_.inputs.push_back(path);
        if (const auto* error = std::get_if<FileError>(&text)) {
            report_unreadable(path, *error, asked_at);
            return;
        }
        chain_.push_back(path);
        load_text(std::get<std::string>(std::move(text)), path.string(), path.parent_path());
        chain_.pop_back();
    }

    void load_text(std::string text, const std::string& name, const fs::path& folder) {
        const bool is_root = !root_loaded_;
        root_loaded_ = true;
        Source& source = add_source(Source::Kind::file, name, std::move(text));
        source.folder = folder;
        if (is_root) root_folder_ = folder;
        std::optional<Table> root =
            is_root ? parse_toml(source, diagnostics_) : parse_include(source);
        if (!root) {
            result_.complete = false;
            if (!is_root) return;
            root.emplace();
        }
        name_listed_towers(*root);
        name_particles_of_layers(*root);
        read_table_files(*root, folder, result_.inputs, diagnostics_);
        check_exclusive_keys(*root, diagnostics_);
        load_preset(effective(*root, "preset", is_root));
        load_includes(effective(*root, "include", is_root), folder);
        // This is the order of overriding, not of reading: a file comes after its includes.
        source.order = next_order_++;
        result_.trees.push_back({&source, std::move(*root)});
    }

    void add_settings() {
        for (SourceTree& tree : settings_) {
            auto* source = const_cast<Source*>(tree.source);
            source->order = next_order_++;
            source->folder = root_folder_;
            read_table_files(tree.root, root_folder_, result_.inputs, diagnostics_);
            result_.trees.push_back(std::move(tree));
        }
    }

  private:
    // Parses an included file. For a file that is no recipe, no line is shown, because it may hold secrets:
    // whoever asked for it may not be who reads the diagnostics.
    std::optional<Table> parse_include(Source& source) {
        DiagnosticList faults;
        std::optional<Table> root = parse_toml(source, faults);
        const bool is_recipe = root && (root->empty() || has_key_of_recipes(*root));
        if (is_recipe) return root;
        const std::vector<Diagnostic> found = faults.take();
        source.text.clear();
        for (const Diagnostic& fault : found) {
            const Place place{&source, fault.where.line, fault.where.column, fault.where.length};
            diagnostics_.error(fault.code, place, "not TOML", no_recipe);
        }
        if (root) {
            diagnostics_.error("E0101", {&source},
                               fmt::format("`{}` has none of a recipe's keys", source.name),
                               no_recipe);
        }
        return std::nullopt;
    }

    Source& add_source(Source::Kind kind, const std::string& name, std::string text) {
        result_.sources.push_back({kind, 0, printable(name), std::move(text)});
        return result_.sources.back();
    }

    void read_setting(const std::string& setting, std::string_view option) {
        Source& source =
            add_source(Source::Kind::setting, fmt::format("{} `{}`", option, shorten(setting)), "");
        const Place place{&source};
        const std::size_t equals = find_equals(setting);
        const std::string_view text = setting;
        const std::optional<std::string> key = equals == std::string_view::npos
                                                   ? std::nullopt
                                                   : parse_toml_key(trim(text.substr(0, equals)));
        const auto names = key ? split_path(*key) : std::nullopt;
        if (!names) {
            diagnostics_.error("E0122", place, "--set takes KEY=VALUE with a dotted key",
                               "for example --set atmosphere.ground_albedo=0.3");
            return;
        }
        if (option == "--set" && !set_keys_.insert(*key).second) {
            diagnostics_.warning("W0224", place, fmt::format("`{}` is set twice", shorten(*key)),
                                 "the last value counts");
        }
        const std::string_view written = trim(text.substr(equals + 1));
        std::optional<Value> value = parse_toml_value(written);
        if (!value) value = Value{std::string(written), {}};
        Table root = wrap(*names, std::move(*value));
        assign_place(root, place);
        name_listed_towers(root);
        name_particles_of_layers(root);
        check_exclusive_keys(root, diagnostics_);
        settings_.push_back({&source, std::move(root)});
    }

    // Returns what a file says under a key at the top level. For the recipe itself, --set overrides
    // it.
    const Value* effective(const Table& root, std::string_view key, bool is_root) const {
        const Entry* entry = find_entry(root, key);
        for (const SourceTree& tree : settings_) {
            const Entry* set = is_root ? find_entry(tree.root, key) : nullptr;
            if (set) entry = set;
        }
        return entry ? &entry->value : nullptr;
    }

    void load_preset(const Value* value) {
        if (!value) return;
        const auto* name = std::get_if<std::string>(&value->data);
        const Preset* preset = name ? find_preset(*name) : nullptr;
        if (!preset) {
            result_.complete = false;
            if (name) report_unknown_preset(*name, value->place);
            return;  // the decoder reports a value that is not a text
        }
        Source& source =
            add_source(Source::Kind::preset, "preset " + *name, std::string(preset->text));
        source.order = next_order_++;
        std::optional<Table> root = parse_toml(source, diagnostics_);
        if (!root) return;
        // Only the recipe itself decides what to bake.
        std::erase_if(*root, [](const Entry& entry) { return entry.key == "bake"; });
        result_.trees.push_back({&source, std::move(*root)});
    }

    void load_includes(const Value* value, const fs::path& folder) {
        if (!value) return;
        if (std::holds_alternative<std::string>(value->data)) {
            load_include(*value, folder);
        } else if (const auto* array = std::get_if<Array>(&value->data)) {
            for (const Value& item : *array) load_include(item, folder);
        } else {
            result_.complete = false;
        }
    }

    void load_include(const Value& value, const fs::path& folder) {
        const auto* name = std::get_if<std::string>(&value.data);
        if (!name) {
            result_.complete = false;  // the decoder reports it
            return;
        }
        const fs::path path = (folder / *name).lexically_normal();
        if (closes_cycle(path, value.place)) return;
        if (result_.inputs.size() >= most_files) {
            result_.complete = false;
            if (!reported_most_files_) {
                diagnostics_.error("E0125", value.place, "too many includes",
                                   fmt::format("a recipe may read at most {} files", most_files));
            }
            reported_most_files_ = true;
            return;
        }
        load_file(path, value.place);
    }

    bool closes_cycle(const fs::path& path, const Place& place) {
        std::size_t first = 0;
        while (first < chain_.size() && !is_same_file(chain_[first], path)) ++first;
        if (first == chain_.size()) return false;
        std::string names;
        for (std::size_t i = first; i < chain_.size(); ++i) {
            names += chain_[i].string() + " includes ";
        }
        result_.complete = false;
        diagnostics_.error("E0116", place, "cyclic include: " + printable(names + path.string()),
                           "a file cannot include itself");
        return true;
    }

    void report_unknown_preset(const std::string& name, const Place& place) {
        const std::vector<std::string_view> names = preset_names();
        std::string label = did_you_mean(name, names);
        if (const SectionPresets* kind = find_section_presets(name)) {
            label = fmt::format("it is a preset of {}s: name it below [{}.NAME]", kind->noun,
                                kind->section);
        } else if (label.empty()) {
            label = fmt::format("choose one of {}", fmt::join(names, ", "));
        }
        diagnostics_.error("E0115", place, fmt::format("unknown preset `{}`", shorten(name)),
                           std::move(label));
    }

    // Returns "did you mean `earth.toml`?" if there is a recipe of a similar name beside `path`.
    static std::string recipe_meant(const fs::path& path) {
        std::error_code ignored;
        if (fs::exists(path, ignored)) return "";
        const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
        std::set<std::string> files;
        for (const auto& entry : fs::directory_iterator(folder, ignored)) {
            if (entry.path().extension() == ".toml") files.insert(entry.path().filename().string());
        }
        const std::vector<std::string_view> names(files.begin(), files.end());
        const std::string words = did_you_mean(path.filename().string(), names);
        return words.empty() && files.size() == 1 ? fmt::format("there is `{}`", *files.begin())
                                                  : words;
    }

    void report_unreadable(const fs::path& path, const FileError& error, const Place& asked_at) {
        result_.complete = false;
        const std::string name = printable(path.string());
        if (error.too_large) {
            diagnostics_.error("E0120", asked_at,
                               fmt::format("`{}` is too large for a recipe", name),
                               fmt::format("at most {} MiB are read", most_recipe_bytes >> 20));
        } else {
            diagnostics_.error("E0300", asked_at,
                               fmt::format("cannot read `{}`: {}", name, error.reason),
                               recipe_meant(path));
        }
    }

    RecipeSources& result_;
    DiagnosticList& diagnostics_;
    std::vector<SourceTree> settings_;
    std::set<std::string> set_keys_;
    std::vector<fs::path> chain_;  // the files that are being read, each included by the one before
    fs::path root_folder_;         // the folder of the recipe itself
    int next_order_ = 0;
    bool root_loaded_ = false;
    bool reported_most_files_ = false;
};

}  // namespace

Source& add_setting(RecipeSources& sources, const std::string& name) {
    int order = 0;
    for (const Source& source : sources.sources) order = std::max(order, source.order + 1);
    sources.sources.push_back({Source::Kind::setting, order, printable(name), ""});
    return sources.sources.back();
}

void add_setting_tree(RecipeSources& sources, const Source& source, Table root) {
    assign_place(root, {&source});
    sources.trees.push_back({&source, std::move(root)});
}

RecipeSources read_sources(const fs::path& path, std::span<const std::string> settings,
                           DiagnosticList& diagnostics, std::span<const std::string> varied) {
    RecipeSources result;
    Loader loader(result, diagnostics);
    loader.read_settings(settings, "--set");
    loader.read_settings(varied, "--vary");
    loader.load_file(path, {});
    loader.add_settings();
    return result;
}

RecipeSources text_sources(std::string text, const std::string& name, const fs::path& folder,
                           std::span<const std::string> settings, DiagnosticList& diagnostics) {
    RecipeSources result;
    Loader loader(result, diagnostics);
    loader.read_settings(settings, "--set");
    loader.load_text(without_byte_order_mark(std::move(text)), name, folder);
    loader.add_settings();
    return result;
}

}  // namespace skybake::config
