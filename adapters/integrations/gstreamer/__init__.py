"""GStreamer, a framework of elements and pads for media, by the Python SDK: a real framework, not made for UCM."""
