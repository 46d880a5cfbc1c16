// A thread that all calls of MPI and PETSc are made in.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

#include "courant/core/solve/equation_engine.hpp"

namespace courant {

// Does jobs, one at a time, for whoever waits for them; and whoever waits can be told that it is in vain, as where a
// rank that MPI waits for is gone.
class PetscThread {
 public:
  // `stop` lives as long, and may be null.
  explicit PetscThread(const std::atomic<bool>* stop) : stop_(stop), thread_([this] { work(); }) {}
  ~PetscThread() {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    changed_.notify_all();
    is_lost_ ? thread_.detach() : thread_.join();
  }

  // Throws what the job throws, and EngineStopped where *stop is set and the job is not at its end half a second later:
  // from then on the thread is lost, and what it uses has to stay. With endless patience *stop is not looked at.
  enum class Patience { until_stopped, endless };
  void run(const std::function<void()>& job, Patience patience = Patience::until_stopped) {
    const std::lock_guard one_at_a_time(asking_);
    std::unique_lock lock(mutex_);
    if (is_lost_) throw EngineStopped("The engine was stopped before.");
    job_ = job;
    has_job_ = true;
    failure_ = nullptr;
    changed_.notify_all();
    int waited = 0;
    while (!changed_.wait_for(lock, kLook, [&] { return !has_job_; }))
      if (patience == Patience::until_stopped && stop_ != nullptr && stop_->load() &&
          ++waited >= kLooks) {
        is_lost_ = true;
        throw EngineStopped(
            "Interrupted within a step: the processes that solve it did not end it.");
      }
    if (failure_) std::rethrow_exception(failure_);
  }

  bool is_lost() const { return is_lost_; }
  void lose() { is_lost_ = true; }

 private:
  static constexpr std::chrono::milliseconds kLook{50};
  static constexpr int kLooks = 10;

  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [&] { return has_job_ || ends_; });
      if (!has_job_) return;
      lock.unlock();
      std::exception_ptr failure;
      try {
        job_();
      } catch (...) {
        failure = std::current_exception();
      }
      lock.lock();
      failure_ = failure;
      has_job_ = false;
      changed_.notify_all();
    }
  }

  const std::atomic<bool>* stop_;
  std::mutex asking_, mutex_;
  std::condition_variable changed_;
  std::function<void()> job_;
  bool has_job_ = false, ends_ = false;
  std::exception_ptr failure_;
  std::atomic<bool> is_lost_ = false;
  std::thread thread_;  // the last one: it uses the others
};

}  // namespace courant
