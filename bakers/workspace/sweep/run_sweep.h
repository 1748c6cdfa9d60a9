// Makes the variants of a sweep that are not up to date, several at a time.
//
// A variant is a bake into a folder, which is done completely or not at all, so a sweep that was
// killed can continue. An asset that several variants need is made by the first that gets to it and
// copied by the others. A variant that fails leaves only its error.json.
#pragma once

#include <string_view>
#include <vector>

#include "bakers/workspace/sweep/sweep_plan.h"
#include "bakers/workspace/sweep/variants.h"

namespace skybake {

// Observes a sweep. Calls come from any thread, one at a time; only `cancelled` may be called
// during another call.
class SweepObserver {
  public:
    virtual ~SweepObserver() = default;
    // Returns true once the user has interrupted.
    virtual bool cancelled() const = 0;
    // Reports the progress of a variant's step, in [0, 1]. It is called often.
    virtual void advance(const VariantResult& variant, std::string_view step, double fraction) = 0;
    // Says that another process works in the variant's folder.
    virtual void waits(const VariantResult& variant) = 0;
    // Says that a variant is finished. `made` is false if it was up to date or failed before
    // anything was tried.
    virtual void finished(const VariantResult& variant, bool made, double seconds) = 0;
};

// Makes the variants of the plan and returns their results in the plan's order. After an
// interruption, variants that were not finished have the status `missing`.
std::vector<VariantResult> run_sweep(const SweepJob& job, std::vector<PlannedVariant> plan,
                                     SweepObserver& observer);

// Returns the results without making anything. A variant that is not up to date counts as failed if
// its folder has an error.json, else as missing.
std::vector<VariantResult> survey_sweep(const SweepJob& job, std::vector<PlannedVariant> plan);

}  // namespace skybake
