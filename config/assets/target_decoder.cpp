#include "config/assets/target_decoder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "config/assets/file_decoder.h"
#include "config/sections/frames.h"
#include "config/sections/targets.h"
#include "config/text/mapped.h"

namespace skybake::config {
namespace {

// Returns the word for the value of a flag or of a choice.
std::string_view word_of(const DecodedField& decoded) {
    if (const bool* flag = std::get_if<bool>(&*decoded.value)) return *flag ? "true" : "false";
    return decoded.field->choices[std::get<ChoiceIndex>(*decoded.value).index].name;
}

// Fills in the keys of one bake for one target.
struct TargetKeys {
    DecodedSection& bake;
    std::string_view asset;
    const TargetFacts& target;
    const TargetUse& use;
    Decoder& decoder;

    void resolve() const {
        resolve_formats();
        resolve_pixel_type();
        for (const TargetKey& key : use.keys) resolve_key(key);
        if (!use.mappings.empty()) resolve_mapping();
    }

    void refuse(const DecodedField& given, std::string_view value, std::string label) const {
        decoder.report(
            "E0160", bake, given.field->key,
            fmt::format(": target \"{}\" does not load {} with {}", target.name, asset, value),
            std::move(label));
    }

    void resolve_formats() const {
        DecodedField& decoded = bake.at("formats");
        if (decoded.source) return check_formats(decoded);
        std::vector<ChoiceIndex> written;
        for (std::size_t i = 0; i < use.written; ++i) {
            written.push_back(chosen(*decoded.field, use.formats[i]));
        }
        derive(decoded, std::move(written));
    }

    void check_formats(const DecodedField& decoded) const {
        const auto name_of = [](FileFormat format) { return facts_of(format).name; };
        const auto& all = use.formats;
        for (const FileFormat format : formats_of(bake)) {
            if (std::ranges::find(all, format) != all.end()) continue;
            const auto loaded = mapped<std::string_view>(all, name_of);
            return refuse(decoded, fmt::format("\"{}\"", name_of(format)),
                          fmt::format("it loads {}", fmt::join(loaded, " and ")));
        }
    }

    void resolve_pixel_type() const {
        DecodedField& decoded = bake.at("pixel_type");
        const auto type = choice_of<PixelType>(decoded);
        if (!decoded.source && use.pixel_type) {
            derive(decoded, chosen(*decoded.field, *use.pixel_type));
            return;
        }
        if (!type || use.pixel_types.contains(*type)) return;
        std::vector<std::string_view> loaded;
        for (const Choice& choice : decoded.field->choices) {
            if (use.pixel_types.contains(static_cast<PixelType>(choice.enumerator))) {
                loaded.push_back(choice.name);
            }
        }
        refuse(decoded, fmt::format("\"{}\"", choice_name(*decoded.field, *type)),
               fmt::format("it loads {}", fmt::join(loaded, ", ")));
    }

    // Whether the key is one of this section, whose other keys decide that.
    bool is_used(const Field& field) const {
        if (field.selector.empty()) return true;
        const DecodedField& selector = bake.at(field.selector);
        return selector.value && applies(field, word_of(selector));
    }

    void resolve_key(const TargetKey& key) const {
        DecodedField& decoded = bake.at(key.key);
        if (!is_used(*decoded.field)) return;
        const bool is_flag = decoded.field->choices.empty();
        derive(decoded, is_flag ? FieldValue(key.word == "true")
                                : FieldValue(choice_named(*decoded.field, key.word)));
        if (!key.is_needed || !decoded.value || word_of(decoded) == key.word) return;
        refuse(decoded, fmt::format("\"{}\"", word_of(decoded)),
               fmt::format("it loads {}", key.word));
    }

    void resolve_mapping() const {
        DecodedField& decoded = bake.at("mapping");
        derive(decoded, FieldValue(choice_named(*decoded.field, use.mappings.front())));
        if (!decoded.value) return;
        std::vector<std::string_view> loaded;
        for (const TargetUse& other : target.uses) {
            if (other.assets != use.assets) continue;
            std::ranges::copy(other.mappings, std::back_inserter(loaded));
        }
        const std::string_view word = word_of(decoded);
        if (std::ranges::find(loaded, word) != loaded.end()) return;
        refuse(decoded, fmt::format("\"{}\"", word),
               fmt::format("it loads {}", fmt::join(loaded, " and ")));
    }

    static ChoiceIndex choice_named(const Field& field, std::string_view word) {
        std::size_t index = 0;
        while (field.choices[index].name != word) ++index;
        return {index};
    }
};

std::vector<std::string_view> assets_of(const TargetFacts& target) {
    std::vector<std::string_view> assets;
    for (const TargetUse& use : target.uses) {
        for (const std::string_view asset : use.assets) {
            if (std::ranges::find(assets, asset) == assets.end()) assets.push_back(asset);
        }
    }
    return assets;
}

// Returns the use of the mapping that the section gives, or null if the target does not load the asset.
const TargetUse* use_of(const DecodedSection& bake, std::string_view asset,
                        const TargetFacts& target) {
    const TargetUse* first = find_use(target, asset);
    if (first == nullptr || first->mappings.empty()) return first;
    const DecodedField& decoded = bake.at("mapping");
    if (!decoded.source || !decoded.value) return first;
    return find_use(target, asset, word_of(decoded));
}

// Reports a section's own target that does not load its asset. That of the whole recipe is for the
// assets that it loads.
void report_no_use(DecodedSection& bake, std::string_view asset, const TargetFacts& target,
                   Decoder& decoder) {
    DecodedField& decoded = bake.at("target");
    const std::string message = fmt::format("[{}]: target \"{}\" does not load the asset {}",
                                            bake.path, target.name, asset);
    if (decoded.source) {
        decoder.diagnostics.error("E0160", decoded.source->place, message,
                                  fmt::format("it loads {}", fmt::join(assets_of(target), ", ")));
        return;
    }
    decoded.value = chosen(*decoded.field, Target::none);
    decoder.diagnostics.warning("W0228", bake.place, message,
                                "its files are the usual ones; `target = \"none\"` says so");
}

// Whether each file of an asset has so many channels of light, or the wavelengths are not known.
bool has_channels(const Parameters& recipe, std::size_t wanted) {
    const std::size_t all = channels_of_light(recipe);
    if (wanted == 0 || all == 0 || all == wanted) return true;
    return wanted == wavelengths_per_packet && !holds_colors(recipe) && all % wanted == 0;
}

}  // namespace

void resolve_target(DecodedSection& bake, std::string_view asset, const Parameters& recipe,
                    Decoder& decoder) {
    DecodedField& decoded = bake.at("target");
    if (recipe.target != Target::none) derive(decoded, chosen(*decoded.field, recipe.target));
    const auto choice = choice_of<Target>(decoded);
    if (!choice || *choice == Target::none) return;
    const TargetFacts& target = facts_of(*choice);
    const Place& place = bake.place_of("target");
    const TargetUse* use = use_of(bake, asset, target);
    if (use == nullptr) return report_no_use(bake, asset, target, decoder);
    TargetKeys{bake, asset, target, *use, decoder}.resolve();
    if (has_channels(recipe, use->light_channels)) return;
    decoder.diagnostics.error(
        "E0160", place,
        fmt::format("[{}]: {} loads light of {} channels, and this recipe has {}", bake.path,
                    target.name, use->light_channels, channels_of_light(recipe)),
        use->light_channels == wavelengths_per_packet
            ? "give `wavelengths` in multiples of four, and no [color]"
            : "give three `wavelengths`, or a [color] with a space");
}

}  // namespace skybake::config
