#include "pipelines/response/end_remedies.hpp"

#include <array>
#include <cstddef>
#include <string>

namespace microslip::pipelines {
namespace {

using solver::Diagnosis;
using solver::NotFound;

struct EndOfCurve {
  Diagnosis value;
  std::string_view remedy;
  std::string_view in_time;  ///< of method = "time"; empty: the same
};

constexpr std::string_view fewer_or_in_time =
    "set response.harmonics to fewer, or response.method = \"time\" with a response.frequency that "
    "begins there";
constexpr std::string_view more_damping =
    "set modes.damping_ratio, of kind modal modal.damping_ratio, to more";

constexpr std::array ends_of_curves{
    EndOfCurve{Diagnosis::none, "", ""},
    EndOfCurve{Diagnosis::no_start,
               "set response.frequency to a range that begins where the response is small, or "
               "response.method = \"time\", which begins at rest",
               ""},
    EndOfCurve{Diagnosis::newton_stall, fewer_or_in_time, ""},
    EndOfCurve{Diagnosis::fold_lost, fewer_or_in_time, ""},
    EndOfCurve{Diagnosis::event_chatter, fewer_or_in_time,
               "set response.steps_per_period to 2000 or more: fixed steps locate no event"},
    EndOfCurve{Diagnosis::branch_jump,
               "set response.search_starts = 20, which looks for the branch that was left, or "
               "response.harmonics to fewer",
               ""},
    EndOfCurve{Diagnosis::loop,
               "set response.frequency to a range that begins beyond that place, or "
               "response.harmonics to fewer; response.search_starts = 20 looks for other branches",
               ""},
    EndOfCurve{Diagnosis::budget,
               "set response.frequency to a part of the range, or response.harmonics to fewer", ""},
    EndOfCurve{
        Diagnosis::out_of_range,
        "set response.frequency to a range that begins farther out, so that the branch can "
        "be followed until it comes back",
        "set response.steps_per_period to 0, or where it is 0 to 2000 or more; a motion that "
        "grows whatever the steps are needs more modes.damping_ratio, of kind modal "
        "modal.damping_ratio"},
    EndOfCurve{Diagnosis::unbounded, more_damping, ""},
    EndOfCurve{Diagnosis::not_periodic,
               "response.method = \"harmonic_balance\" has the motions with the period of the "
               "force, stable or not; with more modes.damping_ratio, of kind modal "
               "modal.damping_ratio, motions settle sooner",
               ""},
    EndOfCurve{Diagnosis::interrupted, "the same command with --resume goes on", ""},
    EndOfCurve{Diagnosis::uncertified,
               "set response.harmonics to another number, or response.method = \"time\"; a contact "
               "many orders of ten stiffer than the structure leaves no digits: is "
               "contact.tangential_stiffness, or contact.normal_stiffness, right?",
               ""},
};

struct EndOfSearch {
  NotFound value;
  std::string_view remedy;
};

constexpr std::array ends_of_searches{
    EndOfSearch{NotFound::none, ""},
    EndOfSearch{NotFound::out_of_time,
                "give --budget more, or set response.optimum_range to an interval around the "
                "lowest so far"},
    EndOfSearch{NotFound::no_solution,
                "set response.frequency to a range that begins where the response is small, or "
                "response.harmonics to fewer"},
    EndOfSearch{NotFound::unsettled,
                "set response.optimum_range to an interval around it, or response.frequency to a "
                "range around the resonance that counts"},
    EndOfSearch{NotFound::flat,
                "any of these is as good; response.optimum_range beyond them would tell others"},
    EndOfSearch{NotFound::at_bound, "set response.optimum_range to one that reaches beyond it"},
    EndOfSearch{NotFound::no_solution_beside,
                "set response.optimum_range to end where there are solutions, or "
                "response.harmonics to fewer"},
    EndOfSearch{NotFound::incomplete_curve,
                "run a curve at this value, which tells why it is incomplete; set "
                "response.frequency to a range around the peak, or response.harmonics to fewer"},
    EndOfSearch{NotFound::unsolved_peak,
                "set response.frequency to a narrower range around the peak, or "
                "response.harmonics to another number"},
};

/// Whether a row for every value is at its place, and has a remedy where anything ended.
template <typename Table>
constexpr bool has_all(const Table& table, std::size_t size) {
  if (table.size() != size) return false;
  for (std::size_t i = 0; i < size; ++i) {
    if (static_cast<std::size_t>(table[i].value) != i) return false;
    if (table[i].remedy.empty() != (i == 0)) return false;
  }
  return true;
}
static_assert(has_all(ends_of_curves, solver::names::diagnoses.size()));
static_assert(has_all(ends_of_searches, static_cast<std::size_t>(NotFound::count)));

}  // namespace

std::string_view remedy_of(Diagnosis diagnosis, ResponseDescription::Method method) {
  const EndOfCurve& end = ends_of_curves.at(static_cast<std::size_t>(diagnosis));
  const bool in_time = method == ResponseDescription::Method::time;
  return in_time && !end.in_time.empty() ? end.in_time : end.remedy;
}

std::string_view remedy_of_time() {
  return "set it to more, or to \"off\", or response.frequency to a part of the range";
}

std::string_view remedy_of(NotFound reason) {
  return ends_of_searches.at(static_cast<std::size_t>(reason)).remedy;
}

void tell_remedy(std::string_view remedy, solver::ResponseCurve& curve) {
  if (remedy.empty()) return;
  if (!curve.message.empty()) curve.message += "; ";
  curve.message += remedy;
}

void tell_remedy(std::string_view remedy, solver::Optimum& optimum) {
  if (remedy.empty()) return;
  for (std::string* text : {&optimum.message, &optimum.objection}) {
    *text += "; ";
    *text += remedy;
  }
}

}  // namespace microslip::pipelines
