#include "cli/bake_reporter.h"

#include <algorithm>
#include <string>

#include "cli/bake_events.h"
#include "cli/bake_progress.h"
#include "cli/bake_summary.h"
#include "cli/console.h"
#include "cli/interrupt.h"

namespace skybake::cli {

bool BakeReporter::cancelled() const { return interrupted(); }

void BakeReporter::waits() {
    console_.note("waiting: another skybake is baking into this folder\n");
}

void BakeReporter::planned(const FolderPlan& plan) {
    if (json_) console_.result(plan_event(plan));
    console_.note(reasons_text(plan));
    for (const PlannedAsset& asset : plan.assets) {
        if (asset.stale()) stale_.push_back(asset.bake->name);
    }
}

std::unique_ptr<Progress> BakeReporter::begin(std::string_view asset) {
    const auto at = std::find(stale_.begin(), stale_.end(), asset);
    const bool counted = at != stale_.end();
    return std::make_unique<BakeProgress>(std::string(asset), console_,
                                          counted ? static_cast<int>(at - stale_.begin()) + 1 : 0,
                                          counted ? static_cast<int>(stale_.size()) : 0);
}

}  // namespace skybake::cli
