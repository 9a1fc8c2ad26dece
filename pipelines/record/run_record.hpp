/// @file
/// What a run leaves behind, kept as it goes: every finished part is on disk before the next
/// begins, so that an error, an interrupt, a full disk or a kill costs only the part it hit. Until
/// the run has come to its end summary.json says that it has not.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <variant>

#include "pipelines/accuracy/error_budget.hpp"
#include "pipelines/files/checkpoint.hpp"
#include "pipelines/model/reduced_model.hpp"
#include "pipelines/record/pictures.hpp"
#include "pipelines/record/progress.hpp"
#include "pipelines/record/run_folder.hpp"
#include "pipelines/record/run_options.hpp"
#include "pipelines/response/run_results.hpp"
#include "pipelines/response/run_summary.hpp"
#include "pipelines/structure/structure_stage.hpp"
#include "pipelines/system/scene_error.hpp"

namespace microslip::pipelines {

class RunRecord {
 public:
  /// Creates the run folder, its lock and log, and writes scene.toml. In the folder of an earlier
  /// run that waits until mesh or model of this one are there: bad input costs nothing. Its results
  /// stay until those of this one's stages take their places.
  /// @throws SceneError, ExhaustedError  as RunFolder.
  RunRecord(const SceneDescription& scene, const RunOptions& options);
  ~RunRecord() = default;
  RunRecord(const RunRecord&) = delete;
  RunRecord& operator=(const RunRecord&) = delete;
  RunRecord(RunRecord&&) = delete;
  RunRecord& operator=(RunRecord&&) = delete;

  /// Where the mesher writes.
  [[nodiscard]] std::filesystem::path mesh_file() const;
  /// The files from which mesh and modes come: of a run that goes on those it was begun with.
  /// @throws SceneError  one of them has changed since.
  void keep_inputs(const SceneDescription& scene);
  /// The mesh.msh that a run which is resumed has left; empty: none.
  [[nodiscard]] std::optional<std::filesystem::path> finished_mesh() const;
  /// What a run that is resumed has finished; empty: to be solved.
  [[nodiscard]] std::optional<StructureModes> finished_modes() const;
  [[nodiscard]] std::optional<CurveResult> finished_curve(const std::string& name) const;
  /// A curve that nothing has cut short: it need not be solved again.
  void keep_finished(const CurveResult& result) const;
  [[nodiscard]] Progress& progress() { return progress_; }

  /// Runs the stages. An exception is written into summary.json with its exit code and thrown on.
  /// An interrupt ends the process within a second, with summary.json written,
  /// even inside a library.
  /// @return exit code: complete, or incomplete when a curve is.
  int run(const std::function<void()>& stages);

  /// Ends the stage before, whose files take their places, and begins this one.
  void stage(const std::string& name);
  void keep_mesh(const mesh::Mesh& mesh, double density);
  /// modes.csv and modes.vtu, residuals and counts to the log.
  void keep_modes(const mesh::Mesh& mesh, const StructureModes& modes,
                  const Eigen::VectorXd& damping_ratio);
  void keep_effects(std::vector<EffectRecord> effects);
  /// model.h5; a modal scene's modes.csv as well.
  void keep_model(const ReducedModel& model);
  /// Forgets curves and errors, and what a resumed run would start from:
  /// those of finer settings come.
  void begin_again();
  /// What the budgets kept so far say about effects left out. @param tolerance  of the peaks.
  /// @param none  as of tell_bounds().
  void keep_bounds(double tolerance, const std::vector<NoBound>& none);
  /// The table of effects to the log, and a warning of each that is left out and should not be.
  void tell_effects();
  /// Of all curves, beside their bars.
  [[nodiscard]] BesideBar left_out();
  /// Whether the accuracy asked for holds for the best value too. @param bar  infinite: not known.
  void judge_optimum(double bar);
  /// The accuracy asked for and whether it is reached.
  void keep_accuracy(AccuracySummary accuracy);
  /// What the curves kept so far say about the effects chosen.
  void keep_choices(const SceneDescription& scene);
  /// Mesh and modes for pictures of the moving blade.
  void keep_structure(const mesh::Mesh& mesh, fem::ModalBasis basis);
  /// A point of a curve that is being solved: kept, should the process have to end within it.
  void note_point(const std::string& curve, const std::variant<double, LimitName>& load,
                  const solver::ResponsePoint& point);
  /// Writes the curves that note_point() has points of and keep_curve() has not seen,
  /// as interrupted.
  void keep_unfinished();
  /// A modal scene's scale is told as the total force it means.
  void keep_curve(const CurveResult& result, const ReducedModel& model);
  /// @return the files, for pictures_of().
  std::vector<std::string> keep_map(const ReducedModel& model, const NamedMap& map,
                                    std::size_t curve);
  /// After all maps and motions that are drawn beside something else of their stage.
  void maps_are_drawn();
  /// Motion of the whole blade at one solution.
  /// @return the files, for pictures_of().
  std::vector<std::string> keep_motion(const std::string& name, const solver::ResponsePoint& point);
  /// What the stage that goes on has drawn of a curve. Empty: a file of it cannot be read.
  [[nodiscard]] std::optional<Pictures> pictures_of(const std::vector<std::string>& maps,
                                                    const std::vector<std::string>& files) const;
  /// What an earlier run has drawn of it.
  void keep_pictures(const Pictures& pictures, std::size_t curve);
  /// For summary.json, before errors are told.
  void note_optimum(const ReducedModel& model, const OptimumRequest& request,
                    const solver::Optimum& optimum, const CurveBudget& budget);
  /// The same with its lines in the log.
  void keep_optimum(const ReducedModel& model, const OptimumRequest& request,
                    const solver::Optimum& optimum, const CurveBudget& budget);
  void keep_bracket(OptimumBracket bracket);
  /// The bar joins the curve's CSV. @param result  kept before; its bar is set.
  void keep_budget(const CurveBudget& budget, BesideBar left_out, const CurveResult& result,
                   const ReducedModel& model);
  /// report.md and plots, of what is there.
  void keep_report();

 private:
  struct Structure {
    mesh::Mesh mesh;
    fem::ModalBasis basis;
  };

  void keep_preload(CurveSummary& summary, const ReducedModel& model, double load);
  void warn_of_unsolved(const CurveResult& result);
  void write_summary_file();
  /// Of what stands in its place so far. Under the mutex.
  void write_summary_so_far();
  /// The files of the stage take their places; those of an earlier run that they succeed are
  /// removed.
  void show_stage();
  /// The same within a stage, as far as nothing of an earlier run stands there.
  void show_what_is_new();
  /// Waits until the run has ended; ends it where it answers neither an interrupt nor the end of
  /// its budget of time.
  void end_in_time(const std::stop_token& stop);
  [[nodiscard]] std::string stage_name() const;
  [[nodiscard]] bool is_overdue() const;
  int finish();
  void fail(ExitCode code, const std::string& message);
  void tell_failure(ExitCode code, const std::string& message);
  [[nodiscard]] ExitCode verdict() const;
  /// Why the accuracy asked for is not reached, or that time was over; empty: neither.
  /// Under the mutex.
  [[nodiscard]] std::string ending() const;
  /// Under mutex_.
  [[nodiscard]] BesideBar left_out_of_curves() const;

  /// Takes the folder over from an earlier run; under mutex_, or before other threads see this.
  void begin();
  void take_over();
  /// Until then its summary.json is kept aside, and put back if this one comes to nothing,
  /// which it then tells.
  void put_summary_aside();
  void take_summary_back();
  void restore_summary(ExitCode code, const std::string& message);

  std::filesystem::path folder_;
  RunStart start_;
  RunFolder place_;
  std::filesystem::path staged_;  ///< where files are written
  Checkpoint checkpoint_;
  std::string scene_toml_;
  bool refines_;           ///< what is left out is taken in by itself, without being told to
  bool begun_ = false;     ///< under mutex_
  bool resumable_ = true;  ///< what is kept is what a resumed run would find again
  bool plots_;             ///< or report.md alone
  Progress progress_;
  std::mutex mutex_;  ///< of summary_: curves finish on several threads, an interrupt on its own
  RunSummary summary_;
  std::vector<ErrorRow> left_out_;  ///< by effects, under mutex_
  std::vector<CurveSummary>
      shown_;  ///< those of summary_ whose files are in their places, under mutex_
  std::map<std::string, CurveResult> unfinished_;  ///< under mutex_
  std::optional<Structure> structure_;
};

}  // namespace microslip::pipelines
