#include "contact/spare_cores.hpp"

#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace microslip::contact {
namespace {

/// Tasks given out one by one.
class Job {
 public:
  Job(std::size_t n, const std::function<void(std::size_t)>& task) : n_(n), task_(task) {}

  void work() {
    for (std::size_t i = next_++; i < n_; i = next_++) {
      try {
        task_(i);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
        next_ = n_;
      }
    }
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::size_t n_;
  const std::function<void(std::size_t)>& task_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::exception_ptr failure_;
};

/// A thread that helps whoever offers it a job, one at a time.
class Helper {
 public:
  Helper() : thread_([this] { serve(); }) {}
  Helper(const Helper&) = delete;
  Helper& operator=(const Helper&) = delete;
  Helper(Helper&&) = delete;
  Helper& operator=(Helper&&) = delete;
  ~Helper() {
    set(State::ended);
    thread_.join();
  }

  void offer(Job& job) {
    job_ = &job;
    set(State::offered);
  }

  /// Returns when the helper has no part in the job any more; one that has not begun need not.
  void take_back() {
    State seen = State::offered;
    if (state_.compare_exchange_strong(seen, State::idle)) return;
    while ((seen = state_.load()) == State::working) wait(seen);
  }

 private:
  enum class State { idle, offered, working, ended };

  void set(State state) {
    state_.store(state);
    state_.notify_all();
  }

  /// Until the state is another. Looks for some 30 us first: to be woken takes as long.
  void wait(State state) const {
    constexpr int looks = 100;
    for (int i = 0; i < looks; ++i) {
      if (state_.load() != state) return;
      std::this_thread::yield();
    }
    state_.wait(state);
  }

  void serve() {
    while (true) {
      State seen = State::offered;
      if (state_.compare_exchange_strong(seen, State::working)) {
        job_->work();
        set(State::idle);
      } else if (seen == State::ended) {
        return;
      } else {
        wait(seen);
      }
    }
  }

  std::atomic<State> state_{State::idle};
  Job* job_ = nullptr;
  std::thread thread_;  // last: it reads the others
};

/// Helpers come into being when first asked for.
class Helpers {
 public:
  void allow(int n_cores) {
    const std::lock_guard lock(mutex_);
    spare_ = n_cores - 1;
  }

  void add(int n) { spare_ += n; }

  /// Up to so many cores to spare, each with a helper.
  [[nodiscard]] std::vector<std::unique_ptr<Helper>> lend(std::size_t most) {
    std::vector<std::unique_ptr<Helper>> lent;
    while (lent.size() < most && take_core()) {
      std::unique_ptr<Helper> helper = free_helper();
      if (!helper) {
        ++spare_;
        break;
      }
      lent.push_back(std::move(helper));
    }
    return lent;
  }

  void give_back(std::vector<std::unique_ptr<Helper>> lent) {
    const std::lock_guard lock(mutex_);
    for (std::unique_ptr<Helper>& helper : lent) {
      free_.push_back(std::move(helper));
      ++spare_;
    }
  }

 private:
  [[nodiscard]] bool take_core() {
    int n = spare_.load();
    while (n > 0) {
      if (spare_.compare_exchange_weak(n, n - 1)) return true;
    }
    return false;
  }

  /// None where the system has no more threads or memory.
  [[nodiscard]] std::unique_ptr<Helper> free_helper() {
    const std::lock_guard lock(mutex_);
    if (!free_.empty()) {
      std::unique_ptr<Helper> helper = std::move(free_.back());
      free_.pop_back();
      return helper;
    }
    try {
      return std::make_unique<Helper>();
    } catch (const std::system_error&) {
      return nullptr;
    } catch (const std::bad_alloc&) {
      return nullptr;
    }
  }

  std::atomic<int> spare_{0};
  std::mutex mutex_;
  std::vector<std::unique_ptr<Helper>> free_;
};

Helpers& helpers() {
  static Helpers all;
  return all;
}

}  // namespace

void allow_cores(int n_cores) { helpers().allow(n_cores); }

CoreShare::CoreShare(Kind kind) : n_(kind == Kind::taken ? -1 : 1) { helpers().add(n_); }

CoreShare::~CoreShare() { helpers().add(-n_); }

void run_on_spare_cores(std::size_t n, const std::function<void(std::size_t)>& task) {
  if (n == 0) return;
  Job job(n, task);
  std::vector<std::unique_ptr<Helper>> lent = helpers().lend(n - 1);
  for (const auto& helper : lent) helper->offer(job);
  job.work();
  for (const auto& helper : lent) helper->take_back();
  helpers().give_back(std::move(lent));
  job.rethrow();
}

}  // namespace microslip::contact
