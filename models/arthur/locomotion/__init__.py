"""The locomotion stack of the report's section 7: from a commanded velocity to joint torques."""
