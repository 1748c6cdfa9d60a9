#include "cli/sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bakers/io/files/to_string.h"
#include "cli/console.h"
#include "cli/events.h"
#include "cli/table_printer.h"

namespace skybake::cli {
namespace {

using Json = nlohmann::ordered_json;

std::size_t up_to_date_count(const std::vector<PlannedVariant>& plan) {
    return static_cast<std::size_t>(std::ranges::count_if(plan, [](const PlannedVariant& variant) {
        return variant.result.status == VariantStatus::done;
    }));
}

std::string folder_of(const SweepJob& job, const VariantResult& variant) {
    return (job.folder / variant.name).string();
}

// Says why a variant is to be baked, asset by asset.
std::string reasons_text(const PlannedVariant& variant) {
    if (variant.result.status == VariantStatus::done) return "up to date";
    if (variant.result.status == VariantStatus::failed) {
        return "cannot be baked: " + first_error(variant.result);
    }
    std::string text;
    for (const StaleAsset& asset : variant.stale) {
        text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", asset.name, asset.reason);
    }
    if (text.empty()) text = "only manifest.json is out of date";
    if (!variant.last_failure.empty()) text += "; it failed last time: " + variant.last_failure;
    return text;
}

std::string_view planned_to_string(VariantStatus status) {
    if (status == VariantStatus::done) return "up_to_date";
    return status == VariantStatus::failed ? "failed" : "stale";
}

}  // namespace

SweepReporter::SweepReporter(const SweepJob& job, std::size_t variants, Console& console)
    : job_(job), variants_(variants), console_(console) {
    line_.emplace(console_, [this] { return text(); });
}

bool SweepReporter::cancelled() const { return interrupted(); }

std::string SweepReporter::count_text() const {
    const double elapsed_s = stopwatch_.seconds();
    std::string text = fmt::format("[{}/{}] variants", finished_, variants_);
    if (failed_ > 0) text += fmt::format(", {} failed", failed_);
    text += fmt::format(", {:.0f} s", elapsed_s);
    if (worked_on_ > 0) {
        const auto left = static_cast<double>(variants_ - finished_);
        // Variants that were up to date took no time.
        text += fmt::format(", about {:.0f} s left", elapsed_s * left / worked_on_);
    }
    return text;
}

std::string SweepReporter::text() const {
    const std::lock_guard lock(mutex_);
    return at_work_.empty() ? count_text() : fmt::format("{}; {}", count_text(), at_work_);
}

void SweepReporter::advance(const VariantResult& variant, std::string_view step, double fraction) {
    const std::lock_guard lock(mutex_);
    at_work_ = fmt::format("{}: {} {:.0f} %", variant.name, step, 100 * fraction);
}

void SweepReporter::waits(const VariantResult& variant) {
    if (console_.error_is_terminal()) console_.rewrite_line("");
    console_.note(fmt::format("waiting: another skybake is baking {}\n", variant.name));
}

void SweepReporter::finished(const VariantResult& variant, bool made, double seconds) {
    const bool failed = variant.status == VariantStatus::failed;
    {
        const std::lock_guard lock(mutex_);
        ++finished_;
        if (failed) ++failed_;
        if (made && !failed) ++made_;
        if (made) ++worked_on_;
        at_work_.clear();
    }
    if (console_.json()) {
        const std::string_view state = failed ? "failed" : made ? "made" : "up_to_date";
        console_.result(event_line({{"event", "variant"},
                                    {"index", variant.index},
                                    {"name", variant.name},
                                    {"path", folder_of(job_, variant)},
                                    {"state", state},
                                    {"seconds", seconds}}));
    }
    if (console_.error_is_terminal() || (!made && !failed)) return;
    console_.note(fmt::format("{} {}, {} ({}/{})\n", variant.name, failed ? "failed" : "baked",
                              time_text(seconds), finished_, variants_));
}

void SweepReporter::finish() { line_.reset(); }

std::string intermediates_note(const std::vector<PlannedVariant>& plan) {
    std::string text;
    for (const PlannedIntermediate& one : shared_intermediates(plan)) {
        if (one.users.size() < 2) continue;
        text += fmt::format("made once: {} ({}, {}) for {}\n", one.need.name,
                            time_text(one.need.seconds),
                            byte_size_text(one.need.memory_mib * 1024 * 1024),
                            counted(one.users.size(), "variant"));
    }
    return text;
}

std::string plan_note(const SweepJob& job, const std::vector<PlannedVariant>& plan) {
    std::string text =
        counted(static_cast<std::size_t>(config::variant_count(job.sweep)), "variant");
    if (job.shards > 1) text += fmt::format(", {} in this shard", plan.size());
    if (const std::size_t count = up_to_date_count(plan); count > 0) {
        text += fmt::format(", {} up to date", count);
    }
    std::string_view separator = "; ";
    for (const SharedAsset& shared : shared_assets(plan)) {
        text +=
            fmt::format("{}{} share {} (baked {})", separator, shared.variants, shared.name,
                        shared.bakes == 1 ? "once" : counted(std::size_t(shared.bakes), "time"));
        separator = ", ";
    }
    return text + "\n";
}

std::string earlier_note(const std::vector<std::string>& folders) {
    constexpr std::size_t most_named = 5;
    if (folders.empty()) return "";
    std::string text = fmt::format(
        "{} no longer in the sweep; kept: {}",
        folders.size() == 1 ? "1 folder is" : fmt::format("{} folders are", folders.size()),
        fmt::join(folders.begin(),
                  folders.begin() + std::ptrdiff_t(std::min(folders.size(), most_named)), ", "));
    if (folders.size() > most_named) {
        text += fmt::format(" and {} more", folders.size() - most_named);
    }
    return text + "\n";
}

std::string plan_table(const std::vector<PlannedVariant>& plan) {
    TextTable table;
    for (const PlannedVariant& variant : plan) {
        table.add_row({variant.result.name, reasons_text(variant)});
    }
    return table.text();
}

std::string sweep_event(const SweepJob& job, const std::vector<PlannedVariant>& plan) {
    Json shared = Json::array();
    for (const SharedAsset& asset : shared_assets(plan)) {
        shared.push_back(
            {{"name", asset.name}, {"variants", asset.variants}, {"bakes", asset.bakes}});
    }
    Json intermediates = Json::array();
    for (const PlannedIntermediate& one : shared_intermediates(plan)) {
        intermediates.push_back({{"name", one.need.name},
                                 {"seconds", one.need.seconds},
                                 {"memory_mib", one.need.memory_mib},
                                 {"variants", one.users.size()}});
    }
    return event_line({{"event", "sweep"},
                       {"variants", config::variant_count(job.sweep)},
                       {"in_shard", plan.size()},
                       {"up_to_date", up_to_date_count(plan)},
                       {"shared", std::move(shared)},
                       {"intermediates", std::move(intermediates)}});
}

std::string planned_variant_events(const SweepJob& job, const std::vector<PlannedVariant>& plan) {
    std::string text;
    for (const PlannedVariant& variant : plan) {
        text += event_line({{"event", "planned_variant"},
                            {"index", variant.result.index},
                            {"name", variant.result.name},
                            {"path", folder_of(job, variant.result)},
                            {"state", planned_to_string(variant.result.status)},
                            {"why", reasons_text(variant)},
                            {"seconds", variant.seconds},
                            {"memory_mib", variant.memory_mib}});
    }
    return text;
}

std::string swept_event(const std::vector<VariantResult>& results, int made, double seconds) {
    const auto count = [&](VariantStatus status) {
        return std::ranges::count_if(
            results, [&](const VariantResult& one) { return one.status == status; });
    };
    return event_line({{"event", "swept"},
                       {"done", count(VariantStatus::done)},
                       {"failed", count(VariantStatus::failed)},
                       {"missing", count(VariantStatus::missing)},
                       {"made", made},
                       {"seconds", seconds}});
}

std::vector<Diagnostic> unfinished(const std::vector<VariantResult>& results) {
    constexpr std::size_t most_named = 5;
    std::vector<Diagnostic> diagnostics;
    for (const VariantStatus status : {VariantStatus::failed, VariantStatus::missing}) {
        std::size_t count = 0;
        std::string names;
        for (const VariantResult& result : results) {
            if (result.status != status) continue;
            if (count++ < most_named) names += (names.empty() ? "" : ", ") + result.name;
        }
        if (count == 0) continue;
        if (count > most_named) names += fmt::format(" and {} more", count - most_named);
        const std::string_view what = status == VariantStatus::failed ? "failed"
                                      : count == 1                    ? "is not baked yet"
                                                                      : "are not baked yet";
        diagnostics.push_back(
            diagnosis("E0406", fmt::format("{} of {} {}: {}", count,
                                           counted(results.size(), "variant"), what, names)));
    }
    return diagnostics;
}

}  // namespace skybake::cli
