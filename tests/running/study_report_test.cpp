#include "courant/running/study_report.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

// Mistakes that these cases have to notice:
//  * the reader takes one count for another
BOOST_AUTO_TEST_SUITE(study_report)

using namespace courant;

namespace {

StudyReport::Method midpoint() {
  return {.experiment = "pendulum, long",
          .method = "midpoint",
          .quantities = {"q", "p_q"},
          .reference = "closed form",
          .order = 2.01,
          .rows = {{.step = 0.1, .error = 1e-3, .seconds = 0.5, .steps = 10, .iterations = 30},
                   {.step = 0.05,
                    .error = 2.5e-4,
                    .order = 2.0,
                    .steps = 20,
                    .iterations = 60,
                    .factorizations = 7,
                    .message = "said \"so\""}}};
}
StudyReport::Method rk4() {
  StudyReport::Method method = midpoint();
  method.method = "rk4";
  method.reference = "rk4 with a step of 0.001";
  method.reference_order = 4;
  method.reference_error = 1e-9;
  method.order.reset();
  method.remark = "too few";
  method.rows.clear();
  return method;
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_is_not_known_is_null) {
  const Json json = to_json({.methods = {midpoint()}});
  const Json& row = json.at("methods")[0].at("rows")[0];
  BOOST_TEST(json.at("status") == "completed");
  BOOST_TEST(row.at("error") == 1e-3);
  BOOST_TEST(row.at("order").is_null());
  BOOST_TEST(json.at("methods")[0].at("reference_order").is_null());
  BOOST_TEST(json.at("methods")[0].at("rows")[1].at("seconds").is_null());
}

// Written, read and written again: the same, with every value of its own in its own place.
BOOST_AUTO_TEST_CASE(the_reader_reads_what_the_writer_writes) {
  const StudyReport report{.is_interrupted = true, .methods = {midpoint(), rk4()}};
  const StudyReport read = read_study_report(to_json(report));
  BOOST_TEST(read.is_interrupted);
  BOOST_TEST_REQUIRE(read.methods.size() == 2u);
  const StudyReport::Row& row = read.methods[0].rows[1];
  BOOST_TEST(row.step == 0.05);
  BOOST_TEST(row.error == 2.5e-4);
  BOOST_TEST(row.order == 2.0);
  BOOST_TEST(std::isnan(row.seconds));
  BOOST_TEST(row.steps == 20);
  BOOST_TEST(row.iterations == 60);
  BOOST_TEST(row.factorizations == 7);
  BOOST_TEST(row.message == "said \"so\"");
  BOOST_TEST(read.methods[0].order.value() == 2.01);
  BOOST_TEST(read.methods[1].reference_order.value() == 4);
  BOOST_TEST(read.methods[1].reference_error == 1e-9);
  BOOST_TEST(!read.methods[1].order.has_value());
  BOOST_TEST(read.methods[1].remark == "too few");
}

BOOST_AUTO_TEST_CASE(what_methods_share_is_told_of_all) {
  const StudyReport same{.methods = {midpoint(), midpoint()}},
      other{.methods = {midpoint(), rk4()}};
  BOOST_TEST(same.reference().value() == "closed form");
  BOOST_TEST(!other.reference().has_value());
  BOOST_TEST(other.quantities().value().size() == 2u);
  BOOST_TEST(!StudyReport{}.reference().has_value());
}

BOOST_AUTO_TEST_CASE(a_line_a_step) {
  BOOST_TEST(study_csv({.methods = {midpoint()}}) ==
             "experiment,method,step,steps,error,order,iterations,factorizations,seconds,message,"
             "reference\n"
             "\"pendulum, long\",midpoint,0.1,10,0.001,,30,0,0.5,,closed form\n"
             "\"pendulum, long\",midpoint,0.05,20,0.00025,2,60,7,,\"said \"\"so\"\"\",closed "
             "form\n");
}

BOOST_AUTO_TEST_CASE(json_of_something_else_is_refused) {
  BOOST_CHECK_THROW(read_study_report(Json::object()), Json::exception);
}

BOOST_AUTO_TEST_SUITE_END()
