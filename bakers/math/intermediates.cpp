#include "bakers/math/intermediates.h"

#include <algorithm>
#include <cassert>

namespace skybake {

struct Intermediates::Node {
    explicit Node(const Need& need)
        : key(need.key), bytes(static_cast<std::int64_t>(need.memory_mib * 1024 * 1024)) {}

    NeedKey key;
    std::int64_t bytes = 0;
    int expected = 0;     // assets that may still ask
    bool making = false;  // a thread makes the value
    std::shared_ptr<const void> value;
};

Intermediates::Intermediates(std::int64_t most_bytes, KeptBytes* kept)
    : most_bytes_(most_bytes), kept_(kept) {
    assert(most_bytes >= 0);
}

Intermediates::~Intermediates() { assert(nodes_.empty()); }

Intermediates::Expected::Expected(Intermediates& owner, std::vector<Need> needs)
    : owner_(&owner), needs_(std::move(needs)) {
    for (const Need& need : needs_) owner_->add(need);
}

Intermediates::Expected::Expected(Expected&& other) noexcept
    : owner_(std::exchange(other.owner_, nullptr)), needs_(std::move(other.needs_)) {}

Intermediates::Expected& Intermediates::Expected::operator=(Expected&& other) noexcept {
    std::swap(owner_, other.owner_);
    std::swap(needs_, other.needs_);
    return *this;
}

Intermediates::Expected::~Expected() {
    if (owner_ == nullptr) return;
    for (const Need& need : needs_) owner_->remove(need);
}

std::shared_ptr<Intermediates::Node> Intermediates::find(const NeedKey& key) const {
    const auto found =
        std::ranges::find_if(nodes_, [&](const auto& node) { return node->key == key; });
    return found != nodes_.end() ? *found : nullptr;
}

void Intermediates::add(const Need& need) {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<Node> node = find(need.key);
    if (!node) nodes_.push_back(node = std::make_shared<Node>(need));
    ++node->expected;
}

void Intermediates::remove(const Need& need) {
    const std::lock_guard lock(mutex_);
    const std::shared_ptr<Node> node = find(need.key);
    if (--node->expected > 0) return;
    if (node->value) kept_bytes_ -= node->bytes;
    std::erase(nodes_, node);
}

// Called under the lock.
void Intermediates::finish(Node& node, const std::shared_ptr<const void>& value) {
    node.making = false;
    made_one_.notify_all();
    if (!value) return;
    ++made_;
    if (node.expected == 0 || kept_bytes_ + node.bytes > most_bytes_) return;
    kept_bytes_ += node.bytes;
    node.value = value;
}

std::shared_ptr<const void> Intermediates::get_any(const NeedKey& key, const Maker& make) {
    std::unique_lock lock(mutex_);
    const std::shared_ptr<Node> node = find(key);
    if (!node) {
        lock.unlock();
        return make();
    }
    made_one_.wait(lock, [&node] { return !node->making; });
    if (node->value) return node->value;
    node->making = true;
    lock.unlock();
    std::shared_ptr<const void> value;
    try {
        value = make();
    } catch (...) {
        lock.lock();
        finish(*node, nullptr);
        throw;
    }
    lock.lock();
    finish(*node, value);
    return value;
}

bool Intermediates::is_shared(const NeedKey& key) const {
    const std::lock_guard lock(mutex_);
    const std::shared_ptr<Node> node = find(key);
    return node && (node->expected > 1 || node->making || node->value);
}

int Intermediates::made() const {
    const std::lock_guard lock(mutex_);
    return made_;
}

std::int64_t Intermediates::kept_bytes() const {
    const std::lock_guard lock(mutex_);
    return kept_bytes_;
}

}  // namespace skybake
