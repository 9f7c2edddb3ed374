"""Are generated C++ headers what clause 13 says? A compiler decides; libclang lists what it cannot see."""
