"""What every answer is: quantities, the power ledger, tables, pages, figures, files."""
