"""The guide's renderings, by Mitsuba's path tracer from our exports, on geometry of our own."""
