#include "bakers/workspace/bake_frames.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "config/assets/asset_kind.h"

namespace skybake {

namespace {

using config::Bake;
using config::Diagnostic;
using config::Outcome;

// Observes a part of a bake whose plan is known.
class PartObserver : public BakeObserver {
  public:
    explicit PartObserver(BakeObserver& whole) : whole_(whole) {}
    bool cancelled() const override { return whole_.cancelled(); }
    void waits() override { whole_.waits(); }
    void planned(const FolderPlan&) override {}
    std::unique_ptr<Progress> begin(std::string_view asset) override { return whole_.begin(asset); }

  private:
    BakeObserver& whole_;
};

bool is_frame(const FolderBake& bake, const Bake& asset) {
    return config::frame_of(bake.recipe->parameters, asset) > 0;
}

// A warning of entries that other parts are about to bake.
bool is_of_other_parts(const Diagnostic& diagnostic) { return diagnostic.code == "W0303"; }

void move_diagnostics(std::vector<Diagnostic> from, std::vector<Diagnostic>& to) {
    std::erase_if(from, is_of_other_parts);
    std::move(from.begin(), from.end(), std::back_inserter(to));
}

// Puts what was made of frames in the place of what a later run says of them.
void restore(std::vector<FinishedAsset> made, BakedFolder& folder) {
    for (FinishedAsset& asset : made) {
        const auto same = std::find_if(
            folder.assets.begin(), folder.assets.end(),
            [&](const FinishedAsset& other) { return other.entry.name == asset.entry.name; });
        if (same != folder.assets.end()) *same = std::move(asset);
    }
}

}  // namespace

bool has_frames(const FolderBake& bake) {
    return std::any_of(bake.bakes.begin(), bake.bakes.end(),
                       [&](const Bake& asset) { return is_frame(bake, asset); });
}

Outcome<BakedFolder> bake_frames_and_folder(const FolderBake& bake, BakeObserver& observer) {
    if (!has_frames(bake)) return bake_folder(bake, observer);
    const Outcome<FolderPlan> plan = plan_folder(bake);
    if (!plan.value) return {{}, plan.diagnostics};
    observer.planned(*plan.value);
    PartObserver quiet(observer);
    std::vector<Diagnostic> warnings;
    std::vector<FinishedAsset> made;
    for (const PlannedAsset& planned : plan.value->assets) {
        if (!planned.stale() || !is_frame(bake, *planned.bake)) continue;
        FolderBake part = bake;
        part.bakes = {*planned.bake};
        part.prune = false;
        Outcome<BakedFolder> baked = bake_folder(part, quiet);
        if (!baked.value) return baked;
        move_diagnostics(std::move(baked.diagnostics), warnings);
        made.push_back(std::move(baked.value->assets.front()));
    }
    Outcome<BakedFolder> outcome = bake_folder(bake, quiet);
    if (outcome.value) restore(std::move(made), *outcome.value);
    std::move(outcome.diagnostics.begin(), outcome.diagnostics.end(), std::back_inserter(warnings));
    outcome.diagnostics = std::move(warnings);
    return outcome;
}

}  // namespace skybake
