"""Tables, documents and the command line."""
