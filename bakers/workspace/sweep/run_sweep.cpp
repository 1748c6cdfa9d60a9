#include "bakers/workspace/sweep/run_sweep.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "bakers/io/files/output_folder.h"
#include "bakers/io/files/stopwatch.h"
#include "bakers/io/files/temporary_file.h"
#include "bakers/math/intermediates.h"
#include "bakers/math/parallel.h"
#include "bakers/math/startable_threads.h"
#include "bakers/workspace/asset_cache.h"
#include "bakers/workspace/bake_folder.h"
#include "bakers/workspace/cache_folder.h"
#include "bakers/workspace/folder_plan.h"
#include "config/diagnostics/diagnostic_codes.h"
#include "config/recipe/recipe.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

Diagnostic internal_error(const std::exception& exception) {
    return diagnosis("E0500", std::string("internal error: ") + exception.what());
}

// Returns an error unless the assets are those that were planned. Otherwise one index would mix
// variants of the recipe before and after a change.
std::vector<Diagnostic> check_against_plan(const FolderBake& bake,
                                           const std::vector<std::string>& planned_keys) {
    std::vector<std::string> keys;
    for (const Bake& section : bake.bakes) {
        auto identity = asset_identity(*bake.recipe, section, bake.certification);
        if (!identity.value) return std::move(identity.diagnostics);
        keys.push_back(std::move(identity.value->key));
    }
    if (keys == planned_keys) return {};
    return {diagnosis("E0406", "the recipe changed while the sweep was running", "run it again")};
}

// Removes temporaries that a killed process has left beside up-to-date files. Does nothing while
// another process has the folder locked, because that process removes them itself.
void remove_left_overs(const std::filesystem::path& folder) {
    const auto lock = FolderLock::acquire(
        folder, [] {}, [] { return true; });
    if (!lock.value) return;
    remove_stale_temporaries_in(folder);
    remove_stale_temporaries(folder / manifest_name);
}

// Passes the calls of one bake's observer on to the sweep's observer, one at a time.
class VariantObserver : public BakeObserver {
  public:
    VariantObserver(const VariantResult& variant, SweepObserver& observer, std::mutex& mutex)
        : variant_(variant), observer_(observer), mutex_(mutex) {}

    bool cancelled() const override { return observer_.cancelled(); }
    void waits() override {
        const std::lock_guard lock(mutex_);
        observer_.waits(variant_);
    }
    void planned(const FolderPlan&) override {}
    std::unique_ptr<Progress> begin(std::string_view asset) override {
        return std::make_unique<Step>(*this, asset);
    }

  private:
    class Step : public Progress {
      public:
        Step(VariantObserver& owner, std::string_view asset) : owner_(owner), asset_(asset) {}
        void advance(std::string_view, double fraction) override {
            const std::lock_guard lock(owner_.mutex_);
            owner_.observer_.advance(owner_.variant_, asset_, fraction);
        }
        bool cancelled() const override { return owner_.cancelled(); }

      private:
        VariantObserver& owner_;
        std::string asset_;
    };

    const VariantResult& variant_;
    SweepObserver& observer_;
    std::mutex& mutex_;
};

// Returns the memory for what variants share: that which none of them needs.
std::int64_t most_kept_bytes(const SweepJob& job, const std::vector<PlannedVariant>& plan) {
    double largest_mib = 0;
    for (const PlannedVariant& variant : plan) {
        largest_mib = std::max(largest_mib, variant.memory_mib);
    }
    return bytes_to_keep(BakeOptions().held_voxel_bytes, job.memory_limit_mib, largest_mib);
}

class SweepRunner {
  public:
    SweepRunner(const SweepJob& job, std::vector<PlannedVariant>& plan, SweepObserver& observer)
        : job_(job),
          plan_(plan),
          observer_(observer),
          kept_(job.cache),
          intermediates_(most_kept_bytes(job, plan), &kept_) {
        share_assets();
        for (std::size_t i = 0; i < plan.size(); ++i) {
            expected_.emplace_back();
            if (!plan[i].to_be_made()) continue;
            waiting_.push_back(i);
            expected_.back() = intermediates_.expect(std::move(plan[i].needs));
        }
    }

    void run() {
        for (PlannedVariant& variant : plan_) {
            if (!variant.to_be_made()) settle(variant);
        }
        const int threads = thread_count(job_.threads);
        int workers = std::min(threads, static_cast<int>(waiting_.size()));
        // The threads of loops come on top of the workers.
        const int wanted = threads + workers;
        if (workers > 1 && startable_threads(wanted) < wanted) workers = 1;
        std::vector<std::thread> others;
        // The remaining threads go to the first workers.
        const auto own = [=](int worker) {
            return threads / workers + (worker < threads % workers ? 1 : 0);
        };
        try {
            for (int worker = 1; worker < workers; ++worker) {
                others.emplace_back([this, count = own(worker)] { work(count); });
            }
        } catch (const std::system_error&) {  // the system grants no more
        }
        if (workers > 0) work(own(0));
        for (std::thread& other : others) other.join();
    }

  private:
    // Registers the assets that two or more variants need, and where up-to-date variants have them.
    void share_assets() {
        std::map<std::string, int> users;
        for (const PlannedVariant& variant : plan_) {
            for (const StaleAsset& asset : variant.stale) ++users[asset.key];
            for (const VariantAsset& asset : variant.result.assets) ++users[asset.key];
        }
        for (const auto& [key, count] : users) {
            if (count > 1) ready_.share(key);
        }
        for (const PlannedVariant& variant : plan_) {
            for (const VariantAsset& asset : variant.result.assets) {
                ready_.add(asset.key, job_.folder / variant.result.name);
            }
        }
    }

    // Finishes a variant that is up to date or that cannot be planned.
    void settle(PlannedVariant& variant) {
        if (observer_.cancelled()) return;
        const auto folder = job_.folder / variant.result.name;
        keep_failure(folder, variant.result);
        if (variant.result.status == VariantStatus::done) remove_left_overs(folder);
        const std::lock_guard lock(observer_mutex_);
        observer_.finished(variant.result, false, 0);
    }

    struct Task {
        std::size_t variant = 0;
        std::vector<std::string> made;  // keys of the shared assets that it makes
    };

    // Returns the next variant that need not wait for another one's assets or memory. Returns
    // nothing once all are taken or the user has interrupted.
    std::optional<Task> next_task() {
        std::unique_lock lock(mutex_);
        while (!waiting_.empty() && !observer_.cancelled()) {
            for (auto it = waiting_.begin(); it != waiting_.end(); ++it) {
                Task task{*it, {}};
                const PlannedVariant& variant = plan_[*it];
                if (!has_memory_for(variant)) continue;
                const auto wanted_keys = mapped<std::string>(variant.stale, &StaleAsset::key);
                if (!ready_.claim(wanted_keys, task.made)) continue;
                waiting_.erase(it);
                ++running_;
                memory_mib_ += variant.memory_mib;
                return task;
            }
            freed_.wait(lock);
        }
        return std::nullopt;
    }

    // A variant that is too large on its own has already failed when it was planned.
    bool has_memory_for(const PlannedVariant& variant) const {
        const double kept_mib = static_cast<double>(intermediates_.kept_bytes()) / kMebibyte;
        // Variants share the program, which each of them counts.
        const double needed_mib = memory_mib_ + variant.memory_mib - running_ * kProgramMib;
        return running_ == 0 || !job_.memory_limit_mib ||
               needed_mib + kept_mib <= *job_.memory_limit_mib;
    }

    void work(int threads) {
        while (const std::optional<Task> task = next_task()) {
            PlannedVariant& variant = plan_[task->variant];
            make(variant, *task, threads);
            ready_.release(task->made);
            expected_[task->variant] = {};
            {
                const std::lock_guard lock(mutex_);
                --running_;
                memory_mib_ -= variant.memory_mib;
            }
            freed_.notify_all();
        }
        wake_others();
    }

    // Notifies under the lock, so that no thread misses it between looking for a task and beginning
    // to wait.
    void wake_others() {
        const std::lock_guard lock(mutex_);
        freed_.notify_all();
    }

    void make(PlannedVariant& variant, const Task& task, int threads) {
        const Stopwatch stopwatch;
        const auto folder = job_.folder / variant.result.name;
        guard(variant.result, [&] { bake(variant, task, threads); });
        if (variant.result.status == VariantStatus::missing) return;  // interrupted
        guard(variant.result, [&] { keep_failure(folder, variant.result); });
        const double elapsed_s = stopwatch.seconds();
        const std::lock_guard lock(observer_mutex_);
        observer_.finished(variant.result, true, elapsed_s);
    }

    // Turns an exception, such as lack of memory, into a failure of the variant, because no
    // exception may leave a thread.
    template <typename Step>
    static void guard(VariantResult& result, const Step& step) {
        try {
            step();
        } catch (const std::exception& exception) {
            fail({internal_error(exception)}, result);
        }
    }

    static void keep_failure(const std::filesystem::path& folder, VariantResult& result) {
        if (result.status == VariantStatus::failed) {
            append(write_failure(folder, result.diagnostics), result);
        } else {
            remove_failure(folder);
        }
    }

    void bake(PlannedVariant& variant, const Task& task, int threads) {
        VariantResult& result = variant.result;
        auto recipe = config::load_variant(job_.recipe, job_.settings, job_.sweep, result.index);
        if (!recipe.value) {  // changed since it was planned
            fail(std::move(recipe.diagnostics), result);
            return;
        }
        FolderBake bake = variant_bake(job_, *recipe.value, result.name);
        bake.threads = threads;
        bake.intermediates = &intermediates_;
        if (auto errors = check_against_plan(bake, variant.keys); !errors.empty()) {
            fail(std::move(errors), result);
            return;
        }
        std::optional<AssetCache> cache;
        bake.sources.push_back(&ready_);
        if (!job_.cache.empty()) bake.sources.push_back(&cache.emplace(job_.cache));
        if (job_.server != nullptr) bake.sources.push_back(job_.server);
        VariantObserver observer(result, observer_, observer_mutex_);
        if (!make_shared_first(bake, variant, task, observer)) return;
        finish(bake_folder(bake, observer), result);
        if (cache) append(cache->problems(), result);
    }

    // Makes the assets that other variants wait for first, so that they need not wait for the rest
    // of this variant.
    bool make_shared_first(const FolderBake& whole, PlannedVariant& variant, const Task& task,
                           VariantObserver& observer) {
        if (task.made.empty() || task.made.size() == variant.stale.size()) return true;
        FolderBake bake = whole;
        std::erase_if(bake.bakes, [&](const Bake& section) {
            const auto asset = std::ranges::find(variant.stale, section.name, &StaleAsset::name);
            return asset == variant.stale.end() ||
                   std::ranges::find(task.made, asset->key) == task.made.end();
        });
        auto baked = bake_folder(bake, observer);
        wake_others();
        if (baked.value && config::exit_code(baked.diagnostics) == 0) return true;
        finish(std::move(baked), variant.result);
        return false;
    }

    // If there is neither a value nor an error, the bake was interrupted and the variant stays
    // missing.
    static void finish(Outcome<BakedFolder> baked, VariantResult& result) {
        if (!baked.value || config::exit_code(baked.diagnostics) != 0) {
            if (!baked.diagnostics.empty()) fail(std::move(baked.diagnostics), result);
            return;
        }
        result.status = VariantStatus::done;
        result.assets.clear();
        for (const FinishedAsset& asset : baked.value->assets) {
            result.assets.push_back(variant_asset(asset.entry));
        }
        append(std::move(baked.diagnostics), result);
    }

    static void fail(std::vector<Diagnostic> diagnostics, VariantResult& result) {
        result.status = VariantStatus::failed;
        result.assets.clear();
        append(std::move(diagnostics), result);
    }

    static void append(std::vector<Diagnostic> diagnostics, VariantResult& result) {
        for (Diagnostic& diagnostic : diagnostics) {
            result.diagnostics.push_back(std::move(diagnostic));
        }
    }

    const SweepJob& job_;
    std::vector<PlannedVariant>& plan_;
    SweepObserver& observer_;
    std::mutex observer_mutex_;
    ReadyAssets ready_;
    CachedBytes kept_;
    Intermediates intermediates_;
    std::vector<Intermediates::Expected> expected_;  // of each variant, until it is made

    std::mutex mutex_;  // guards all members below
    std::condition_variable freed_;
    std::vector<std::size_t> waiting_;  // variants in order
    int running_ = 0;
    double memory_mib_ = 0;  // of the running variants
};

std::vector<VariantResult> results_of(std::vector<PlannedVariant> plan) {
    return mapped<VariantResult>(
        plan, [&](PlannedVariant& variant) { return std::move(variant.result); });
}

}  // namespace

std::vector<VariantResult> run_sweep(const SweepJob& job, std::vector<PlannedVariant> plan,
                                     SweepObserver& observer) {
    SweepRunner(job, plan, observer).run();
    remove_stale_temporaries_in(job.folder);  // temporaries of the index
    return results_of(std::move(plan));
}

std::vector<VariantResult> survey_sweep(const SweepJob& job, std::vector<PlannedVariant> plan) {
    for (PlannedVariant& variant : plan) {
        if (!variant.to_be_made()) continue;
        VariantResult& result = variant.result;
        result.assets.clear();
        std::vector<Diagnostic> errors = read_failure(job.folder / result.name);
        if (errors.empty()) continue;
        result.status = VariantStatus::failed;
        result.diagnostics = std::move(errors);
    }
    return results_of(std::move(plan));
}

}  // namespace skybake
