#include "config/sections/targets.h"

#include <algorithm>
#include <cassert>

#include "config/sections/files.h"
#include "config/sections/frames.h"

namespace skybake::config {
namespace {

bool has_word(const std::vector<std::string_view>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

const TargetFacts& facts_of(Target target) {
    const auto all = targets();
    const auto found = std::find_if(all.begin(), all.end(), [target](const TargetFacts& facts) {
        return facts.target == target;
    });
    assert(found != all.end());
    return *found;
}

const TargetUse* find_use(const TargetFacts& target, std::string_view asset,
                          std::string_view mapping) {
    const TargetUse* first = nullptr;
    for (const TargetUse& use : target.uses) {
        if (!has_word(use.assets, asset)) continue;
        if (has_word(use.mappings, mapping)) return &use;
        if (first == nullptr) first = &use;
    }
    return first;
}

std::span<const Choice> target_choices() {
    static const std::vector<Choice> choices = [] {
        std::vector<Choice> all;
        for (const TargetFacts& facts : targets()) {
            all.emplace_back(facts.target, facts.name, facts.documentation);
        }
        all.emplace_back(Target::none, "none", "no program: the files are the asset's usual ones");
        return all;
    }();
    return choices;
}

std::vector<std::string> sidecar_names(const AssetFiles& files, std::string_view asset,
                                       const std::string& name) {
    std::vector<std::string> names;
    if (files.target == Target::none) return names;
    const TargetUse* use = find_use(facts_of(files.target), asset);
    if (use == nullptr) return names;
    const bool plays = files.frames > 0;
    for (const std::string_view pattern : use->sidecars) {
        // One file that plays a sequence has no file of texels of its own name beside it.
        if (plays && pattern.starts_with("*.bin")) continue;
        names.push_back((plays ? sequence_name(name) : name) + std::string(pattern.substr(1)));
    }
    return names;
}

}  // namespace skybake::config
