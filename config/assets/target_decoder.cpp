#include "config/assets/target_decoder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "config/sections/targets.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

// Fills in the keys of one bake for one target.
class TargetKeys {
  public:
    TargetKeys(DecodedSection& bake, std::string_view asset, const TargetFacts& target,
               const TargetUse& use, Decoder& decoder)
        : bake_(bake), asset_(asset), target_(target), use_(use), decoder_(decoder) {}

    void resolve() {
        resolve_formats();
        resolve_pixel_type();
        for (const TargetKey& key : use_.keys) resolve_key(key);
    }

  private:
    void refuse(const DecodedField& given, std::string_view value, std::string label) const {
        decoder_.diagnostics.error(
            "E0160", given.source->place,
            fmt::format("`{}`: {} cannot load {} with {}", join_path(bake_.path, given.field->key),
                        target_.name, asset_, value),
            std::move(label));
    }

    void resolve_formats() {
        DecodedField& decoded = bake_.at("formats");
        if (decoded.source) return check_formats(decoded);
        std::vector<ChoiceIndex> written;
        for (std::size_t i = 0; i < use_.written; ++i) {
            written.push_back(chosen(*decoded.field, use_.formats[i]));
        }
        derive(decoded, std::move(written));
    }

    void check_formats(const DecodedField& decoded) const {
        if (!decoded.value) return;
        std::vector<FileFormat> given;
        assign(*decoded.field, *decoded.value, given);
        std::vector<std::string_view> loaded;
        for (const FileFormat format : use_.formats) loaded.push_back(facts_of(format).name);
        for (const FileFormat format : given) {
            const auto& all = use_.formats;
            if (std::find(all.begin(), all.end(), format) != all.end()) continue;
            const std::string_view name = facts_of(format).name;
            refuse(decoded, fmt::format("\"{}\"", name),
                   fmt::format("it loads {}", fmt::join(loaded, " and ")));
            return;
        }
    }

    void resolve_pixel_type() {
        DecodedField& decoded = bake_.at("pixel_type");
        const auto type = choice_of<PixelType>(decoded);
        if (!decoded.source && use_.pixel_type) {
            derive(decoded, chosen(*decoded.field, *use_.pixel_type));
            return;
        }
        if (!type || use_.pixel_types.contains(*type)) return;
        std::vector<std::string_view> loaded;
        for (const Choice& choice : decoded.field->choices) {
            if (use_.pixel_types.contains(static_cast<PixelType>(choice.enumerator))) {
                loaded.push_back(choice.name);
            }
        }
        refuse(decoded, fmt::format("\"{}\"", choice_name(*decoded.field, *type)),
               fmt::format("it loads {}", fmt::join(loaded, ", ")));
    }

    void resolve_key(const TargetKey& key) {
        DecodedField& decoded = bake_.at(key.key);
        const bool is_flag = decoded.field->choices.empty();
        if (is_flag) {
            derive(decoded, FieldValue(key.word == "true"));
        } else {
            derive(decoded, FieldValue(choice_named(*decoded.field, key.word)));
        }
        if (!key.is_needed || !decoded.value || word_of(decoded) == key.word) return;
        refuse(decoded, fmt::format("\"{}\"", word_of(decoded)),
               fmt::format("it loads {}", key.word));
    }

    static ChoiceIndex choice_named(const Field& field, std::string_view word) {
        std::size_t index = 0;
        while (field.choices[index].name != word) ++index;
        return {index};
    }

    // Returns the word for the value of a flag or of a choice.
    static std::string_view word_of(const DecodedField& decoded) {
        if (const bool* flag = std::get_if<bool>(&*decoded.value)) return *flag ? "true" : "false";
        return decoded.field->choices[std::get<ChoiceIndex>(*decoded.value).index].name;
    }

    DecodedSection& bake_;
    std::string_view asset_;
    const TargetFacts& target_;
    const TargetUse& use_;
    Decoder& decoder_;
};

std::vector<std::string_view> assets_of(const TargetFacts& target) {
    std::vector<std::string_view> assets;
    for (const TargetUse& use : target.uses) {
        assets.insert(assets.end(), use.assets.begin(), use.assets.end());
    }
    return assets;
}

}  // namespace

void resolve_target(DecodedSection& bake, std::string_view asset, Target usual, Decoder& decoder) {
    DecodedField& decoded = bake.at("target");
    if (usual != Target::none) derive(decoded, chosen(*decoded.field, usual));
    const auto choice = choice_of<Target>(decoded);
    if (!choice) return;
    const TargetFacts& target = facts_of(*choice);
    if (const TargetUse* use = find_use(target, asset)) {
        TargetKeys(bake, asset, target, *use, decoder).resolve();
        return;
    }
    decoder.diagnostics.error(
        "E0160", decoded.source ? decoded.source->place : bake.place,
        fmt::format("[{}]: {} has no use for the asset {}", bake.path, target.name, asset),
        fmt::format("it loads {}", fmt::join(assets_of(target), ", ")));
}

}  // namespace skybake::config
