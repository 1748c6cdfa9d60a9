// Scripts of sweeps for engines that read a description of the job as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cli/sweep.h"

namespace skybake::cli {
namespace {

using Json = nlohmann::ordered_json;

// Returns the words of a command, without the program, as an array.
Json arguments(const SweepScript& script, const std::vector<std::string>& more) {
    Json list = Json::array();
    for (std::size_t i = 1; i < script.words.size(); ++i) list.push_back(script.words[i]);
    for (const std::string& word : more) list.push_back(word);
    return list;
}

std::vector<std::string> shard_words(const SweepScript& script, const std::string& task) {
    return {"-j", std::to_string(script.threads), "--shard",
            fmt::format("{}/{}", task, script.tasks)};
}

Json openjd_run(const SweepScript& script, Json words) {
    return {{"actions", {{"onRun", {{"command", script.words[0]}, {"args", std::move(words)}}}}}};
}

// Returns the folders that a container must see, none of them below another one.
std::set<std::string> outermost_folders(const SweepScript& script) {
    std::set<std::string> folders;
    for (const std::filesystem::path& folder : script.mounts) {
        const std::string text = folder.string();
        const auto is_above = [](const std::string& above, const std::string& below) {
            return below == above || below.starts_with(above == "/" ? above : above + "/");
        };
        if (std::ranges::any_of(folders,
                                [&](const std::string& known) { return is_above(known, text); })) {
            continue;
        }
        std::erase_if(folders, [&](const std::string& known) { return is_above(text, known); });
        folders.insert(text);
    }
    return folders;
}

// Escapes a word of a container's command, in which Kubernetes replaces $(NAME) and $$.
std::string kubernetes_word(const std::string& word) {
    std::string text;
    for (const char c : shell_word(word)) text += c == '$' ? "$$" : std::string(1, c);
    return text;
}

}  // namespace

std::string openjd_template(const SweepScript& script) {
    const Json bake = {
        {"name", "Bake"},
        {"parameterSpace",
         {{"taskParameterDefinitions",
           Json::array({{{"name", "Shard"},
                         {"type", "INT"},
                         {"range", fmt::format("1-{}", script.tasks)}}})}}},
        {"hostRequirements",
         {{"amounts", Json::array({{{"name", "amount.worker.vcpu"}, {"min", script.threads}}})}}},
        {"script",
         openjd_run(script, arguments(script, shard_words(script, "{{Task.Param.Shard}}")))}};
    const Json merge = {{"name", "Merge"},
                        {"dependencies", Json::array({{{"dependsOn", "Bake"}}})},
                        {"script", openjd_run(script, arguments(script, {"--merge"}))}};
    const Json job = {{"specificationVersion", "jobtemplate-2023-09"},
                      {"name", "skybake sweep"},
                      {"description", fmt::format("A sweep of {} variants in {} tasks",
                                                  script.variants, script.tasks)},
                      {"steps", Json::array({bake, merge})}};
    return job.dump(2) + "\n";
}

std::string kubernetes_job(const SweepScript& script) {
    // Kubernetes counts from 0, shards from 1.
    std::string command = "exec skybake";
    for (std::size_t i = 1; i < script.words.size(); ++i) {
        command += ' ' + kubernetes_word(script.words[i]);
    }
    command += fmt::format(" -j {} --shard \"$((JOB_COMPLETION_INDEX + 1))/{}\"", script.threads,
                           script.tasks);
    Json mounts = Json::array();
    for (const std::string& folder : outermost_folders(script)) {
        // A claim's folder of the same path keeps several mounts apart.
        mounts.push_back({{"name", "work"}, {"mountPath", folder}, {"subPath", folder.substr(1)}});
    }
    const Json container = {
        {"name", "skybake"},
        {"image", script.image},
        {"command", Json::array({"sh", "-c", command})},
        {"resources", {{"requests", {{"cpu", std::to_string(script.threads)}}}}},
        {"volumeMounts", std::move(mounts)}};
    const Json job = {
        {"apiVersion", "batch/v1"},
        {"kind", "Job"},
        {"metadata", {{"generateName", "skybake-sweep-"}}},
        {"spec",
         {{"completionMode", "Indexed"},
          {"completions", script.tasks},
          {"parallelism", script.tasks},
          {"backoffLimit", 2 * script.tasks},
          {"template",
           {{"spec",
             {{"restartPolicy", "Never"},
              {"containers", Json::array({container})},
              {"volumes",
               Json::array({{{"name", "work"},
                             {"persistentVolumeClaim", {{"claimName", "skybake"}}}}})}}}}}}}};
    return job.dump(2) + "\n";
}

}  // namespace skybake::cli
