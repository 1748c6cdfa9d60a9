// Makes the variants of a sweep that are not up to date, side by side.
//
// A variant is a bake of a folder, whole or not at all, so a sweep that is killed goes on where it
// was. An asset that several variants want is made by the first that gets to it and copied by the
// others. One that fails leaves its error.json and no more.
#pragma once

#include <string_view>
#include <vector>

#include "bakers/workspace/sweep/sweep_plan.h"
#include "bakers/workspace/sweep/variants.h"

namespace skybake {

// Whoever watches a sweep. Calls come one at a time, from any thread; only `cancelled` may be
// called while another one is.
class SweepObserver {
  public:
    virtual ~SweepObserver() = default;
    // True once the user has interrupted.
    virtual bool cancelled() const = 0;
    // How far the step of a variant is, in [0, 1]; often.
    virtual void advance(const VariantResult& variant, std::string_view step, double fraction) = 0;
    // Another process is at work in the variant's folder.
    virtual void waits(const VariantResult& variant) = 0;
    // `made` is false for one that was up to date or failed before anything was tried.
    virtual void finished(const VariantResult& variant, bool made, double seconds) = 0;
};

// Makes what the plan says, and returns its results, in the plan's order. After an interruption
// those that were not finished are missing.
std::vector<VariantResult> run_sweep(const SweepJob& job, std::vector<PlannedVariant> plan,
                                     SweepObserver& observer);

// What there is, without making anything: what is not up to date has failed, where its folder says
// so, or is missing.
std::vector<VariantResult> survey_sweep(const SweepJob& job, std::vector<PlannedVariant> plan);

}  // namespace skybake
