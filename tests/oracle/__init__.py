"""An independent truth: the platform in MuJoCo. Development only."""
