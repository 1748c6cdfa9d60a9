#include "cli/bake_reporter.h"

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
}

std::unique_ptr<Progress> BakeReporter::begin(std::string_view asset) {
    return std::make_unique<BakeProgress>(std::string(asset), console_);
}

}  // namespace skybake::cli
