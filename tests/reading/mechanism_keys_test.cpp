#include "courant/reading/mechanism_keys.hpp"

#include <boost/test/unit_test.hpp>
#include <set>

namespace courant {
// Mistakes that these cases have to notice:
//  * a joint is driven by a key that it does not have
BOOST_AUTO_TEST_SUITE(mechanism_keys_test)

BOOST_AUTO_TEST_CASE(joints_have_words_and_keys_that_drive_them) {
  std::set<std::string> words, keys;
  for (const Key& key : joint_keys().keys) keys.insert(key.name);
  for (const JointWord& joint : joint_types()) {
    BOOST_TEST(words.insert(joint.word).second, joint.word);
    BOOST_TEST((joint.type == JointType::fixed) == std::string(joint.effort).empty());
    BOOST_TEST((joint.type == JointType::fixed || keys.contains(joint.effort)), joint.word);
  }
  BOOST_TEST(words.size() == joint_words().size());
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
