"""What is said of the end of a drive's march."""

from asperity.drive.protocols.judgement import Judgement


def test_what_a_longer_march_would_do_is_told_only_where_it_was_asked():
    found = Judgement.of(0.02, 0.0, 0.0, 0.0, 30)
    assert not found.settled
    assert found.said("torque") == "the torque of three blocks of cycles spreads by 2 %"
